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

template <class... Args>
void set_args(const ClKernel& kernel, const Args&... args) {
  cl_uint index = 0;
  const auto set = [&](const auto& value) {
    check_opencl(opencl().clSetKernelArg(kernel.get(), index++, sizeof(value), &value), "clSetKernelArg");
  };
  (set(args), ...);
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

double KernelRunner::run(const ClKernel& kernel, std::size_t size, void* out, std::size_t bytes) {
  const Stopwatch watch;
  const std::size_t local = 64, global = (size + local - 1) / local * local;
  check_opencl(opencl().clEnqueueNDRangeKernel(device_.queue(), kernel.get(), 1, nullptr, &global, &local, 0,
                                               nullptr, nullptr),
               "clEnqueueNDRangeKernel");
  device_.finish();
  const double seconds = watch.seconds();
  check_opencl(opencl().clEnqueueReadBuffer(device_.queue(), result_.get(), CL_TRUE, 0, bytes, out, 0,
                                            nullptr, nullptr),
               "clEnqueueReadBuffer");
  return seconds;
}

double KernelRunner::shared(float max_distance, std::vector<std::uint32_t>& bits) {
  bits.resize(point_count_);
  if (result_bytes_ < bits.size() * 4) result_ = device_.buffer(result_bytes_ = bits.size() * 4);
  set_args(shared_, nodes_.get(), leaves_.get(), points_.get(), point_count_, sets_.get(), set_size_,
           max_distance, result_.get());
  const std::size_t per_stream = 32 / set_size_;
  return run(shared_, (point_count_ + per_stream - 1) / per_stream, bits.data(), bits.size() * 4);
}

double KernelRunner::own(float max_distance, std::vector<std::uint32_t>& bits) {
  bits.resize((point_count_ + 31) / 32);
  if (result_bytes_ < bits.size() * 4) result_ = device_.buffer(result_bytes_ = bits.size() * 4);
  set_args(own_, nodes_.get(), leaves_.get(), points_.get(), point_count_, sets_.get(), set_size_,
           max_distance, result_.get());
  return run(own_, bits.size(), bits.data(), bits.size() * 4);
}

double KernelRunner::closest(const vec3& eye, unsigned rays_per_stream, std::vector<float>& distances) {
  distances.resize(direction_count_);
  if (result_bytes_ < distances.size() * 4) result_ = device_.buffer(result_bytes_ = distances.size() * 4);
  set_args(closest_, nodes_.get(), leaves_.get(), directions_.get(), direction_count_, eye.x, eye.y, eye.z,
           cl_uint(rays_per_stream), result_.get());
  return run(closest_, (direction_count_ + rays_per_stream - 1) / rays_per_stream, distances.data(),
             distances.size() * 4);
}

}  // namespace nook::bench
