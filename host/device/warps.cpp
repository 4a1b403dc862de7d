#include "device/warps.hpp"

#include <cstring>

#include "device/kernel_call.hpp"
#include "device/kernel_source.hpp"

namespace nook {
namespace {

template <class T>
std::span<const float> floats(std::span<const T> values) {
  return {reinterpret_cast<const float*>(values.data()), values.size() * sizeof(T) / sizeof(float)};
}

template <class T>
std::vector<T> vectors(const std::vector<float>& values) {
  std::vector<T> out(values.size() * sizeof(float) / sizeof(T));
  std::memcpy(out.data(), values.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace

Warps::Warps(const Device& device) : Warps(device, kernel_source("sample/warps.cl")) {}

Warps::Warps(const Device& device, const std::string& source)
    : device_(device), program_(build_program(device, source, BuildOptions())) {}

std::vector<vec3> Warps::map(Warp warp, std::span<const vec2> u, float exponent) const {
  return vectors<vec3>(run("warp_map", warp, exponent, floats(u), u.size(), 3));
}

std::vector<vec2> Warps::inverse(Warp warp, std::span<const vec3> w, float exponent) const {
  return vectors<vec2>(run("warp_inverse", warp, exponent, floats(w), w.size(), 2));
}

std::vector<float> Warps::pdf(Warp warp, std::span<const vec3> w, float exponent) const {
  return run("warp_pdf", warp, exponent, floats(w), w.size(), 1);
}

std::vector<float> Warps::run(const char* kernel_name, Warp warp, float exponent, std::span<const float> in,
                              std::size_t count, std::size_t floats_out) const {
  std::vector<float> result(count * floats_out);
  if (count == 0) return result;
  const std::vector<float> held(in.begin(), in.end());
  const ClBuffer source = device_.input(held);
  const ClBuffer destination = device_.buffer(result.size() * sizeof(float));
  const ClKernel kernel = program_.kernel(kernel_name);
  KernelCall call(kernel);
  call.add("warp", cl_uint(warp)).add("exponent", exponent).add("in", source).add("out", destination);
  call.add("count", cl_uint(count)).run(device_, count);
  read_buffer(device_, destination, result.data(), result.size() * sizeof(float));
  return result;
}

}  // namespace nook
