#include "bench/support/kernel_runner.hpp"

#include "base/embedded_file.hpp"
#include "bench/support/stopwatch.hpp"
#include "device/kernel_source.hpp"

namespace nook::bench {

namespace kernels {
extern const EmbeddedFile files[];
}

namespace {

BuildOptions with_width(BuildOptions options, unsigned width) {
  return options.define("BVH_WIDTH", width);
}

}  // namespace

KernelRunner::KernelRunner(const Device& device, const Bvh& bvh, const BuildOptions& options)
    : device_(device),
      program_(build_program(device, flatten_kernel(kernels::files[0].path, kernels::files[0].text),
                             with_width(options, bvh.width()))),
      shared_(program_.kernel("occlusion_shared")),
      own_(program_.kernel("occlusion_own")),
      closest_(program_.kernel("closest_shared")),
      nodes_(device.input(bvh.nodes)),
      leaves_(device.input(bvh.leaves)) {}

void KernelRunner::set_points(const std::vector<RayPoint>& points, const DirectionSets& sets) {
  static_assert(sizeof(RayPoint) == 9 * sizeof(float));
  points_ = device_.input(points);
  sets_ = device_.input(sets.directions);
  point_count_ = cl_uint(points.size());
  set_size_ = sets.size;
}

void KernelRunner::set_camera_rays(const std::vector<vec3>& directions) {
  directions_ = device_.input(directions);
  direction_count_ = cl_uint(directions.size());
}

double KernelRunner::run(KernelCall& call, std::size_t size, void* out, std::size_t bytes) {
  constexpr std::size_t local = 64;
  call.add("result", result_);
  const Stopwatch watch = started();
  call.run(device_, (size + local - 1) / local * local, local);
  device_.finish();
  const double seconds = watch.seconds();
  read_buffer(device_, result_, out, bytes);
  return seconds;
}

double KernelRunner::occlusion(const ClKernel& kernel, std::size_t streams, float max_distance,
                               std::vector<std::uint32_t>& bits) {
  if (result_bytes_ < bits.size() * 4) result_ = device_.buffer(result_bytes_ = bits.size() * 4);
  KernelCall call(kernel);
  call.add("nodes", nodes_).add("leaves", leaves_).add("points", points_).add("point_count", point_count_);
  call.add("sets", sets_).add("set_size", set_size_).add("max_distance", max_distance);
  return run(call, streams, bits.data(), bits.size() * 4);
}

double KernelRunner::shared(float max_distance, std::vector<std::uint32_t>& bits) {
  bits.resize(point_count_);
  const std::size_t per_stream = 32 / set_size_;
  return occlusion(shared_, (point_count_ + per_stream - 1) / per_stream, max_distance, bits);
}

double KernelRunner::own(float max_distance, std::vector<std::uint32_t>& bits) {
  bits.resize((point_count_ + 31) / 32);
  return occlusion(own_, bits.size(), max_distance, bits);
}

double KernelRunner::closest(const vec3& eye, unsigned rays_per_stream, std::vector<float>& distances) {
  distances.resize(direction_count_);
  if (result_bytes_ < distances.size() * 4) result_ = device_.buffer(result_bytes_ = distances.size() * 4);
  KernelCall call(closest_);
  call.add("nodes", nodes_).add("leaves", leaves_).add("directions", directions_);
  call.add("direction_count", direction_count_).add("eye_x", eye.x).add("eye_y", eye.y).add("eye_z", eye.z);
  call.add("rays_per_stream", cl_uint(rays_per_stream));
  return run(call, (direction_count_ + rays_per_stream - 1) / rays_per_stream, distances.data(),
             distances.size() * 4);
}

}  // namespace nook::bench
