#pragma once

#include <cstddef>
#include <string>

#include "device/device.hpp"

namespace nook {

/// A kernel's arguments, set one after the other in the kernel's order, and its launch:
///
///     KernelCall call(kernel);
///     call.add("u", buffer).add("count", count);
///     call.run(device, count);
///
/// Errors name the argument.
class KernelCall {
 public:
  explicit KernelCall(cl_kernel kernel) : kernel_(kernel) {}
  explicit KernelCall(const ClKernel& kernel) : kernel_(kernel.get()) {}
  explicit KernelCall(ClKernel&&) = delete;  // it must outlive the call

  /// Throws Error(internal) for an empty buffer, Error(device).
  KernelCall& add(const char* name, const ClBuffer& buffer);
  KernelCall& add(const char* name, cl_mem buffer);
  template <class T>
  KernelCall& add(const char* name, const T& value) {
    set(name, &value, sizeof value);
    return *this;
  }

  /// Launches `work_items` work-items, in groups of `group` (0: the device chooses). `event`: of the launch.
  /// Throws Error(internal) if the kernel has more arguments than were added, Error(device).
  void run(const Device& device, std::size_t work_items, std::size_t group = 0,
           ClEvent* event = nullptr) const;

 private:
  void set(const char* name, const void* value, std::size_t bytes);

  cl_kernel kernel_;
  cl_uint next_ = 0;
};

/// Copies device memory to the host, when the work so far is done. Throws Error(device).
void read_buffer(const Device& device, const ClBuffer& buffer, void* out, std::size_t bytes);

}  // namespace nook
