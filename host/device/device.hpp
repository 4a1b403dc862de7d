#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "device/opencl.hpp"

namespace nook {

/// What `nook devices` prints of one OpenCL device.
struct DeviceInfo {
  cl_platform_id platform = nullptr;
  cl_device_id id = nullptr;
  unsigned platform_index = 0;
  unsigned device_index = 0;  ///< within the platform
  std::string platform_name;
  std::string name;
  std::string vendor;
  std::string driver;
  std::string version;
  std::string extensions;
  cl_device_type type = 0;
  unsigned compute_units = 0;
  std::uint64_t memory = 0;          ///< bytes
  std::uint64_t max_allocation = 0;  ///< bytes, of one buffer
  unsigned native_float_width =
      0;                       ///< floats in a native vector; 16 with AVX-512, 8 with AVX2, 1 on most GPUs
  bool shares_memory = false;  ///< with the host: buffers are used in place
  bool is_cpu() const { return (type & CL_DEVICE_TYPE_CPU) != 0; }
  /// An interpreter (oclgrind), or a GPU in software (rusticl on llvmpipe, SwiftShader): a hundred times
  /// slower than a compiling driver on the same processor.
  bool is_slow() const;
};

/// All devices of all platforms, in the loader's order; empty if there is no platform.
/// Throws Error(device) if there is no OpenCL loader.
std::vector<DeviceInfo> list_devices();

/// The device that a selector names: "cpu", "gpu", "P:D" (indices as printed by `nook devices`), or a part of
/// the platform's or device's name, case-insensitive; "": any. Of several the first that is not slow, a CPU
/// before others. Null: none matches.
const DeviceInfo* choose_device(std::span<const DeviceInfo> devices, const std::string& selector);

/// The same of list_devices(). Throws Error(device) with one line if there is no device or none matches.
DeviceInfo select_device(const std::string& selector);

/// One device, its context and its in-order queue.
class Device {
 public:
  /// Throws Error(device).
  explicit Device(const DeviceInfo& info);

  const DeviceInfo& info() const { return info_; }
  cl_context context() const { return context_.get(); }
  cl_command_queue queue() const { return queue_.get(); }
  cl_device_id id() const { return info_.id; }

  /// A buffer of device memory. bytes may be 0 (one unused byte is reserved: OpenCL has no empty buffers).
  /// Throws Error(device) that says how much was asked and how much there is.
  ClBuffer buffer(std::size_t bytes, cl_mem_flags flags = CL_MEM_READ_WRITE) const;

  /// The contents of `data` for the device to read: used in place where memory is shared, so `data` must
  /// outlive the buffer; copied otherwise.
  template <class T, class Allocator>
  ClBuffer input(const std::vector<T, Allocator>& data) const {
    return input_bytes(data.data(), data.size() * sizeof(T));
  }
  template <class... Vectors>
  ClBuffer input(const std::variant<Vectors...>& data) const {
    return std::visit([this](const auto& chosen) { return input(chosen); }, data);
  }

  std::uint64_t bytes_uploaded() const { return bytes_uploaded_; }
  void finish() const;

 private:
  ClBuffer input_bytes(const void* data, std::size_t bytes) const;

  DeviceInfo info_;
  ClContext context_;
  ClQueue queue_;
  mutable std::uint64_t bytes_uploaded_ = 0;
};

}  // namespace nook
