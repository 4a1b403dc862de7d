#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <string>
#include <utility>

namespace nook {

// The OpenCL functions nook calls, loaded when first needed: a run without an effect for rays never maps
// libOpenCL.
// clang-format wraps these macros anew at each run.
// clang-format off
#define NOOK_OPENCL_FUNCTIONS(X) \
  X(clGetPlatformIDs) X(clGetPlatformInfo) X(clGetDeviceIDs) X(clGetDeviceInfo) X(clCreateContext) \
  X(clReleaseContext) X(clCreateCommandQueue) X(clReleaseCommandQueue) X(clCreateBuffer) \
  X(clReleaseMemObject) X(clCreateProgramWithSource) X(clCreateProgramWithBinary) X(clBuildProgram) \
  X(clGetProgramBuildInfo) X(clGetProgramInfo) X(clReleaseProgram) X(clCreateKernel) \
  X(clReleaseKernel) X(clSetKernelArg) X(clGetKernelInfo) X(clEnqueueNDRangeKernel) X(clEnqueueReadBuffer) \
  X(clEnqueueWriteBuffer) X(clWaitForEvents) X(clReleaseEvent) X(clGetEventProfilingInfo) X(clFlush) \
  X(clFinish)
// clang-format on

struct OpenClFunctions {
#define X(name) decltype(&::name) name = nullptr;
  NOOK_OPENCL_FUNCTIONS(X)
#undef X
};

/// The loaded functions. Throws Error(device) if there is no OpenCL loader library (libOpenCL.so.1, or what
/// NOOK_OPENCL names).
const OpenClFunctions& opencl();

/// True once opencl() has been called in this process.
bool opencl_is_loaded();

/// "CL_OUT_OF_RESOURCES" for -5.
std::string opencl_error_name(cl_int code);

/// Throws Error(device) "<what>: <code's name>" unless code is CL_SUCCESS.
void check_opencl(cl_int code, const char* what);

/// Owns one OpenCL object; `release` is the member of OpenClFunctions that gives it back.
template <class T, auto release>
class ClHandle {
 public:
  ClHandle() = default;
  explicit ClHandle(T object) : object_(object) {}
  ClHandle(ClHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  ClHandle& operator=(ClHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~ClHandle() {
    if (object_) (opencl().*release)(object_);
  }
  T get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  T object_ = nullptr;
};

using ClContext = ClHandle<cl_context, &OpenClFunctions::clReleaseContext>;
using ClQueue = ClHandle<cl_command_queue, &OpenClFunctions::clReleaseCommandQueue>;
using ClBuffer = ClHandle<cl_mem, &OpenClFunctions::clReleaseMemObject>;
using ClProgram = ClHandle<cl_program, &OpenClFunctions::clReleaseProgram>;
using ClKernel = ClHandle<cl_kernel, &OpenClFunctions::clReleaseKernel>;
using ClEvent = ClHandle<cl_event, &OpenClFunctions::clReleaseEvent>;

}  // namespace nook
