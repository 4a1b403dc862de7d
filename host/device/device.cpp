#include "device/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/error.hpp"
#include "device/pocl_folder.hpp"

namespace nook {
namespace {

template <class Get>
std::string text_of(Get get) {
  std::size_t bytes = 0;
  get(0, nullptr, &bytes);
  std::string text(bytes, '\0');
  get(bytes, text.data(), nullptr);
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

std::string device_text(cl_device_id id, cl_device_info what) {
  return text_of(
      [&](std::size_t n, void* p, std::size_t* used) { opencl().clGetDeviceInfo(id, what, n, p, used); });
}

template <class T>
T device_value(cl_device_id id, cl_device_info what) {
  T value{};
  opencl().clGetDeviceInfo(id, what, sizeof(T), &value, nullptr);
  return value;
}

DeviceInfo describe(cl_platform_id platform, cl_device_id id) {
  DeviceInfo info;
  info.platform = platform;
  info.id = id;
  info.platform_name = text_of([&](std::size_t n, void* p, std::size_t* used) {
    opencl().clGetPlatformInfo(platform, CL_PLATFORM_NAME, n, p, used);
  });
  info.name = device_text(id, CL_DEVICE_NAME);
  info.vendor = device_text(id, CL_DEVICE_VENDOR);
  info.driver = device_text(id, CL_DRIVER_VERSION);
  info.version = device_text(id, CL_DEVICE_VERSION);
  info.extensions = device_text(id, CL_DEVICE_EXTENSIONS);
  info.type = device_value<cl_device_type>(id, CL_DEVICE_TYPE);
  info.compute_units = device_value<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS);
  info.memory = device_value<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
  info.max_allocation = device_value<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  info.native_float_width = device_value<cl_uint>(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT);
  info.shares_memory = device_value<cl_bool>(id, CL_DEVICE_HOST_UNIFIED_MEMORY) == CL_TRUE || info.is_cpu();
  return info;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

bool contains(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

// Without a wish: processors before GPUs before what is left, which is slow (see is_slow()); among equals the
// loader's order.
int rank(const DeviceInfo& device) {
  if (device.is_slow()) return 2;
  return device.is_cpu() ? 0 : 1;
}

}  // namespace

bool DeviceInfo::is_slow() const {
  return contains(lower(platform_name + '\n' + name),
                  {"oclgrind", "llvmpipe", "softpipe", "swiftshader", "swrast", "lavapipe"});
}

const DeviceInfo* choose_device(std::span<const DeviceInfo> devices, const std::string& selector) {
  const std::string wanted = lower(selector);
  const auto matches = [&](const DeviceInfo& d) {
    if (wanted.empty()) return true;
    if (wanted == "cpu") return d.is_cpu();
    if (wanted == "gpu") return (d.type & CL_DEVICE_TYPE_GPU) != 0;
    if (wanted == fmt::format("{}:{}", d.platform_index, d.device_index)) return true;
    if (std::isdigit(static_cast<unsigned char>(wanted[0])) && wanted.find(':') != std::string::npos)
      return false;
    return contains(lower(d.name), {wanted.c_str()}) || contains(lower(d.platform_name), {wanted.c_str()});
  };
  const DeviceInfo* best = nullptr;
  for (const DeviceInfo& device : devices)
    if (matches(device) && (!best || rank(device) < rank(*best))) best = &device;
  return best;
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> found;
  cl_uint platform_count = 0;
  if (opencl().clGetPlatformIDs(0, nullptr, &platform_count) != CL_SUCCESS) return found;
  std::vector<cl_platform_id> platforms(platform_count);
  opencl().clGetPlatformIDs(platform_count, platforms.data(), nullptr);
  for (unsigned p = 0; p < platform_count; ++p) {
    cl_uint device_count = 0;
    if (opencl().clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, 0, nullptr, &device_count) != CL_SUCCESS)
      continue;
    std::vector<cl_device_id> ids(device_count);
    opencl().clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, device_count, ids.data(), nullptr);
    for (unsigned d = 0; d < device_count; ++d) {
      found.push_back(describe(platforms[p], ids[d]));
      found.back().platform_index = p;
      found.back().device_index = d;
    }
  }
  return found;
}

DeviceInfo select_device(const std::string& selector) {
  const std::vector<DeviceInfo> devices = list_devices();
  // PoCL offers no device where it cannot write.
  if (devices.empty() && problem_of_pocl_folder()) throw *problem_of_pocl_folder();
  if (devices.empty())
    throw Error(
        ErrorKind::device,
        "no OpenCL device found; on Debian: apt-get install pocl-opencl-icd (`nook doctor` says more)");
  if (const DeviceInfo* chosen = choose_device(devices, selector)) return *chosen;
  if (problem_of_pocl_folder()) throw *problem_of_pocl_folder();
  throw Error(ErrorKind::device,
              fmt::format("no OpenCL device matches '{}'; `nook devices` lists the {} there are", selector,
                          devices.size()));
}

Device::Device(const DeviceInfo& info) : info_(info) {
  if (info.platform_name == "Portable Computing Language" && problem_of_pocl_folder())
    throw *problem_of_pocl_folder();
  cl_int code = CL_SUCCESS;
  const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM, cl_context_properties(info.platform), 0};
  context_ = ClContext(opencl().clCreateContext(properties, 1, &info_.id, nullptr, nullptr, &code));
  check_opencl(code, "cannot create an OpenCL context");
  queue_ = ClQueue(opencl().clCreateCommandQueue(context_.get(), info_.id, CL_QUEUE_PROFILING_ENABLE, &code));
  check_opencl(code, "cannot create an OpenCL queue");
}

ClBuffer Device::buffer(std::size_t bytes, cl_mem_flags flags) const {
  cl_int code = CL_SUCCESS;
  ClBuffer made(
      opencl().clCreateBuffer(context_.get(), flags, std::max<std::size_t>(bytes, 1), nullptr, &code));
  if (code != CL_SUCCESS)
    throw Error(ErrorKind::device,
                fmt::format("device memory: {} bytes asked, {} allowed in one piece, {} in all on {} ({}); "
                            "render it in tiles with --crop, or on another --device",
                            bytes, info_.max_allocation, info_.memory, info_.name, opencl_error_name(code)));
  return made;
}

ClBuffer Device::input_bytes(const void* data, std::size_t bytes) const {
  if (bytes == 0) return buffer(0, CL_MEM_READ_ONLY);
  cl_int code = CL_SUCCESS;
  const cl_mem_flags how = info_.shares_memory ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR;
  ClBuffer made(
      opencl().clCreateBuffer(context_.get(), CL_MEM_READ_ONLY | how, bytes, const_cast<void*>(data), &code));
  if (code != CL_SUCCESS)
    throw Error(
        ErrorKind::device,
        fmt::format("the scene does not fit the device: {} bytes asked, {} allowed in one piece, {} "
                    "in all on {} ({}); tiles would not help: take a smaller mesh or another --device",
                    bytes, info_.max_allocation, info_.memory, info_.name, opencl_error_name(code)));
  bytes_uploaded_ += bytes;
  return made;
}

void Device::finish() const {
  check_opencl(opencl().clFinish(queue_.get()), "the device failed");
}

}  // namespace nook
