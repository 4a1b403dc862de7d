#include "device/kernel_call.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace nook {

void KernelCall::set(const char* name, const void* value, std::size_t bytes) {
  if (const cl_int code = opencl().clSetKernelArg(kernel_, next_, bytes, value); code != CL_SUCCESS)
    check_opencl(code, fmt::format("cannot set a kernel's argument {} ({})", next_, name).c_str());
  ++next_;
}

KernelCall& KernelCall::add(const char* name, cl_mem buffer) {
  if (!buffer)
    throw Error(ErrorKind::internal, fmt::format("a kernel's argument {} ({}) is missing", next_, name));
  set(name, &buffer, sizeof buffer);
  return *this;
}

KernelCall& KernelCall::add(const char* name, const ClBuffer& buffer) {
  return add(name, buffer.get());
}

void KernelCall::run(const Device& device, std::size_t work_items, std::size_t group, ClEvent* event) const {
  cl_uint arguments = 0;
  check_opencl(opencl().clGetKernelInfo(kernel_, CL_KERNEL_NUM_ARGS, sizeof arguments, &arguments, nullptr),
               "cannot read a kernel's arguments");
  if (arguments != next_)
    throw Error(ErrorKind::internal,
                fmt::format("a kernel takes {} arguments and was given {}", arguments, next_));
  cl_event raw = nullptr;
  check_opencl(opencl().clEnqueueNDRangeKernel(device.queue(), kernel_, 1, nullptr, &work_items,
                                               group ? &group : nullptr, 0, nullptr, event ? &raw : nullptr),
               "cannot launch a kernel");
  if (event) *event = ClEvent(raw);
}

void read_buffer(const Device& device, const ClBuffer& buffer, void* out, std::size_t bytes) {
  check_opencl(
      opencl().clEnqueueReadBuffer(device.queue(), buffer.get(), CL_TRUE, 0, bytes, out, 0, nullptr, nullptr),
      "the device failed");
}

}  // namespace nook
