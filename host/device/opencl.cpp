#include "device/opencl.hpp"

#include <dlfcn.h>

#include <atomic>
#include <cstdlib>

#include "base/driver_threads.hpp"
#include "base/error.hpp"
#include "device/pocl_folder.hpp"

namespace nook {
namespace {

std::atomic<bool> loaded = false;

OpenClFunctions load() {
  limit_driver_threads(0);  // unless that is settled already
  prepare_for_pocl();
  const char* name = std::getenv("NOOK_OPENCL");
  if (!name || !*name) name = "libOpenCL.so.1";
  void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw Error(ErrorKind::device, std::string("no OpenCL loader: cannot load ") + name +
                                       "; on Debian: apt-get install ocl-icd-libopencl1 pocl-opencl-icd");
  OpenClFunctions functions;
#define X(function)                                                                               \
  functions.function = reinterpret_cast<decltype(functions.function)>(dlsym(library, #function)); \
  if (!functions.function)                                                                        \
    throw Error(ErrorKind::device, std::string("the OpenCL loader ") + name + " has no " #function);
  NOOK_OPENCL_FUNCTIONS(X)
#undef X
  loaded = true;
  return functions;
}

}  // namespace

const OpenClFunctions& opencl() {
  static const OpenClFunctions functions = load();
  return functions;
}

bool opencl_is_loaded() {
  return loaded;
}

std::string opencl_error_name(cl_int code) {
  switch (code) {
// clang-format wraps these macros anew at each run.
// clang-format off
#define NAME(code) case code: return #code;
    NAME(CL_SUCCESS) NAME(CL_DEVICE_NOT_FOUND) NAME(CL_DEVICE_NOT_AVAILABLE)
    NAME(CL_COMPILER_NOT_AVAILABLE) NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE) NAME(CL_OUT_OF_RESOURCES)
    NAME(CL_OUT_OF_HOST_MEMORY) NAME(CL_BUILD_PROGRAM_FAILURE) NAME(CL_MAP_FAILURE) NAME(CL_INVALID_VALUE)
    NAME(CL_INVALID_DEVICE) NAME(CL_INVALID_PLATFORM) NAME(CL_INVALID_CONTEXT) NAME(CL_INVALID_BINARY)
    NAME(CL_INVALID_BUILD_OPTIONS) NAME(CL_INVALID_PROGRAM) NAME(CL_INVALID_PROGRAM_EXECUTABLE)
    NAME(CL_INVALID_KERNEL_NAME) NAME(CL_INVALID_KERNEL_ARGS) NAME(CL_INVALID_ARG_INDEX)
    NAME(CL_INVALID_ARG_VALUE) NAME(CL_INVALID_ARG_SIZE) NAME(CL_INVALID_WORK_GROUP_SIZE)
    NAME(CL_INVALID_BUFFER_SIZE) NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)
#undef NAME
        // clang-format on
        case -1001 : return "CL_PLATFORM_NOT_FOUND_KHR";
    default:
      return "OpenCL error " + std::to_string(code);
  }
}

void check_opencl(cl_int code, const char* what) {
  if (code != CL_SUCCESS) throw Error(ErrorKind::device, std::string(what) + ": " + opencl_error_name(code));
}

}  // namespace nook
