#include "ray_tester.hpp"

#include "device/kernel_source.hpp"
#include "support/kernels.hpp"

namespace nook::testing {
namespace {

const char* const source = R"(
#include "trace/origin.cl"
#include "trace/traverse.cl"

float3 load_direction(__global const float* stream, uint k) {
  return (float3)(stream[3 + 3 * k], stream[4 + 3 * k], stream[5 + 3 * k]);
}

void load_stream(__global const float* stream, RayDirections* origins, RayDirections* directions) {
  for (uint k = 0; k < 32; ++k) {
    const float3 d = load_direction(stream, k);
    origins->x[k] = stream[0], origins->y[k] = stream[1], origins->z[k] = stream[2];
    directions->x[k] = d.x, directions->y[k] = d.y, directions->z[k] = d.z;
  }
}

__kernel void test_occluded(BVH_PARAMS, __global const float* streams, float max_distance, __global uint* bits) {
  const uint i = get_global_id(0);
  RayDirections o, d;
  load_stream(streams + 99 * i, &o, &d);
  bits[i] = occluded_from(BVH_ARGS, ray_direction(&o, 0), &d, 0xffffffffu, max_distance);
}

__kernel void test_occluded_own(BVH_PARAMS, __global const float* streams, float max_distance, __global uint* bits) {
  const uint i = get_global_id(0);
  RayDirections o, d;
  load_stream(streams + 99 * i, &o, &d);
  bits[i] = occluded_rays(BVH_ARGS, &o, &d, 0xffffffffu, max_distance);
}

__kernel void test_closest(BVH_PARAMS, __global const float* streams, float limit, __global float* hits) {
  const uint i = get_global_id(0);
  RayDirections o, d;
  load_stream(streams + 99 * i, &o, &d);
  float t[32], u[32], v[32];
  uint triangle[32];
  for (uint k = 0; k < 32; ++k) t[k] = limit;
  closest_from(BVH_ARGS, ray_direction(&o, 0), &d, 0xffffffffu, t, triangle, u, v);
  for (uint k = 0; k < 32; ++k) {
    __global float* out = hits + 4 * (32 * i + k);
    out[0] = t[k];
    out[1] = u[k];
    out[2] = v[k];
    out[3] = as_float(triangle[k]);
  }
}

Vector load_vector(__global const float* p) {
  const Vector v = {p[0], p[1], p[2]};
  return v;
}

__kernel void test_offset(BVH_PARAMS, __global const float* samples, float unused, __global float* origins) {
  __global const float* s = samples + 15 * get_global_id(0);
  Vector o;
  offset_origin(load_vector(s), load_vector(s + 3), load_vector(s + 6), s[12], s[13], load_vector(s + 9), s[14], load_vector(s),
                load_vector(s + 9), INFINITY, &o);
  __global float* out = origins + 3 * get_global_id(0);
  out[0] = o.x, out[1] = o.y, out[2] = o.z;
}
)";

static_assert(sizeof(SurfaceSample) == 15 * sizeof(float));
static_assert(sizeof(RayStream) == 99 * sizeof(float));
static_assert(sizeof(ClosestHit) == 4 * sizeof(float));

template <class Input>
void run(const Device& device, const ClKernel& kernel, const Bvh& bvh, const std::vector<Input>& streams,
         float distance, void* out, std::size_t bytes) {
  const auto& cl = opencl();
  const ClBuffer nodes = device.input(bvh.nodes), leaves = device.input(bvh.leaves),
                 rays = device.input(streams);
  const ClBuffer result = device.buffer(bytes);
  const cl_mem buffers[] = {nodes.get(), leaves.get(), rays.get(), result.get()};
  for (cl_uint i = 0; i < 3; ++i)
    check_opencl(cl.clSetKernelArg(kernel.get(), i, sizeof(cl_mem), &buffers[i]), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 3, sizeof(float), &distance), "clSetKernelArg");
  check_opencl(cl.clSetKernelArg(kernel.get(), 4, sizeof(cl_mem), &buffers[3]), "clSetKernelArg");
  const std::size_t size = streams.size();
  check_opencl(cl.clEnqueueNDRangeKernel(device.queue(), kernel.get(), 1, nullptr, &size, nullptr, 0, nullptr,
                                         nullptr),
               "clEnqueueNDRangeKernel");
  check_opencl(
      cl.clEnqueueReadBuffer(device.queue(), result.get(), CL_TRUE, 0, bytes, out, 0, nullptr, nullptr),
      "clEnqueueReadBuffer");
}

std::string source_of(const TraversalVariant& variant) {
  const std::string text = flatten_kernel("ray_tester", source);
  return variant.avx512 ? text : test::without_avx512(text);
}

Bvh tree_of(const TriangleMesh& mesh, unsigned width) {
  return build_bvh(mesh, {.width = width, .refined = width == 8});
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const TraversalVariant& variant) {
  return out << variant.name;
}

void RayTester::take(const TriangleMesh& mesh) {
  bvh_ = tree_of(mesh, width_);
}

RayTester::RayTester(const TriangleMesh& mesh, const TraversalVariant& variant)
    : width_(variant.width),
      bvh_(tree_of(mesh, variant.width)),
      device_(test::device()),
      program_(build_program(device_, source_of(variant),
                             BuildOptions(variant.options).define("BVH_WIDTH", variant.width))) {}

std::vector<std::uint32_t> RayTester::bits(const char* kernel, const std::vector<RayStream>& streams,
                                           float max_distance) {
  std::vector<std::uint32_t> result(streams.size());
  run(device_, program_.kernel(kernel), bvh_, streams, max_distance, result.data(), result.size() * 4);
  return result;
}

std::vector<std::uint32_t> RayTester::occluded(const std::vector<RayStream>& streams, float max_distance) {
  return bits("test_occluded", streams, max_distance);
}

std::vector<std::uint32_t> RayTester::occluded_own_origins(const std::vector<RayStream>& streams,
                                                           float max_distance) {
  return bits("test_occluded_own", streams, max_distance);
}

std::vector<vec3> RayTester::offset_origins(const std::vector<SurfaceSample>& samples) {
  std::vector<vec3> result(samples.size());
  run(device_, program_.kernel("test_offset"), bvh_, samples, 0.0f, result.data(),
      result.size() * sizeof(vec3));
  return result;
}

std::vector<ClosestHit> RayTester::closest(const std::vector<RayStream>& streams, float limit) {
  std::vector<ClosestHit> result(streams.size() * 32);
  run(device_, program_.kernel("test_closest"), bvh_, streams, limit, result.data(),
      result.size() * sizeof(ClosestHit));
  return result;
}

std::vector<TraversalVariant> traversal_variants() {
  std::vector<TraversalVariant> variants;
  for (const unsigned width : {16u, 8u}) {
    const std::string of = ", " + std::to_string(width) + " children a node";
    variants.push_back({"stream" + of, {}, width});
    variants.push_back({"portable stream" + of, BuildOptions().define("TRAVERSAL_PORTABLE", 1), width});
    variants.push_back({"scalar" + of, BuildOptions().define("TRAVERSAL_SCALAR", 1), width});
  }
  variants.push_back({"stream without AVX-512, 8 children a node", {}, 8, false});
  return variants;
}

}  // namespace nook::testing
