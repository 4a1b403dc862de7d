#pragma once

#include "bench/support/rays.hpp"
#include "bvh/bvh.hpp"
#include "device/device.hpp"
#include "device/kernel_call.hpp"
#include "device/program_cache.hpp"

namespace nook::bench {

/// Our side: the tree on the device and the kernels of bench/kernels/occlusion.cl.
class KernelRunner {
 public:
  /// options: -D settings of the traversal. The buffers use bvh in place: it must outlive the runner.
  KernelRunner(const Device& device, const Bvh& bvh, const BuildOptions& options);

  void set_points(const std::vector<RayPoint>& points, const DirectionSets& sets);
  /// Each returns the seconds from enqueue to finish. `bits` gets a word for each point (or 32 points).
  double shared(float max_distance, std::vector<std::uint32_t>& bits);
  double own(float max_distance, std::vector<std::uint32_t>& bits);

  void set_camera_rays(const std::vector<vec3>& directions);
  double closest(const vec3& eye, unsigned rays_per_stream, std::vector<float>& distances);

 private:
  double occlusion(const ClKernel& kernel, std::size_t work_items, float max_distance,
                   std::vector<std::uint32_t>& bits);
  double run(KernelCall& call, std::size_t work_items, void* out, std::size_t bytes);

  const Device& device_;
  BuiltProgram program_;
  ClKernel shared_, own_, closest_;
  ClBuffer nodes_, leaves_, points_, sets_, directions_, result_;
  std::size_t result_bytes_ = 0;
  cl_uint point_count_ = 0, set_size_ = 0, direction_count_ = 0;
};

}  // namespace nook::bench
