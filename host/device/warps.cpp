#include "device/warps.hpp"

#include <cstring>

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
  const OpenClFunctions& cl = opencl();
  ClKernel kernel = program_.kernel(kernel_name);
  ClBuffer source = device_.buffer(in.size_bytes(), CL_MEM_READ_ONLY);
  ClBuffer destination = device_.buffer(result.size() * sizeof(float));
  check_opencl(cl.clEnqueueWriteBuffer(device_.queue(), source.get(), CL_TRUE, 0, in.size_bytes(), in.data(),
                                       0, nullptr, nullptr),
               "clEnqueueWriteBuffer");
  cl_uint kind = cl_uint(warp), n = cl_uint(count);
  cl_mem from = source.get(), to = destination.get();
  check_opencl(cl.clSetKernelArg(kernel.get(), 0, sizeof kind, &kind), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 1, sizeof exponent, &exponent), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 2, sizeof from, &from), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 3, sizeof to, &to), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 4, sizeof n, &n), "clSetKernelArg");
  check_opencl(cl.clEnqueueNDRangeKernel(device_.queue(), kernel.get(), 1, nullptr, &count, nullptr, 0,
                                         nullptr, nullptr),
               "clEnqueueNDRangeKernel");
  check_opencl(cl.clEnqueueReadBuffer(device_.queue(), destination.get(), CL_TRUE, 0,
                                      result.size() * sizeof(float), result.data(), 0, nullptr, nullptr),
               "clEnqueueReadBuffer");
  return result;
}

}  // namespace nook
