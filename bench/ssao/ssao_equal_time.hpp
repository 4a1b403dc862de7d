#pragma once

#include <vector>

#include "bench/ssao/ssao_errors.hpp"
#include "render/scene_renderer.hpp"

namespace nook::bench {

/// Ray-traced AO within a given time, by nook's own tracer.
class TracedAo {
 public:
  /// radius: of the AO, world units. Camera, size and mesh are the scene's.
  TracedAo(const Scene& scene, const TriangleMesh& mesh, float radius);

  struct Result {
    std::uint32_t directions;   ///< from each pixel's one surface point
    double seconds;             ///< of the fastest of three runs (of one, if it takes longer than a second)
    std::vector<float> values;  ///< row-major; 0 for a miss
  };
  /// As many directions as fit into the time; at least 1, even if that takes longer.
  Result in_time(double seconds) const;

 private:
  Result run(std::uint32_t directions) const;
  SceneRenderer renderer_;
  double seconds_of_camera_rays_, seconds_per_direction_;
};

/// The filter of SSAO (glsl/denoise.frag) on any values, on the processor: two passes of 2 radius + 1 pixels,
/// each neighbour weighted by how far its inverse depth is off the pixel's tangent plane.
/// hits: of all pixels, row-major.
std::vector<float> edge_aware_blur(const Camera& camera, int width, int height,
                                   const std::vector<PrimaryHit>& hits, std::vector<float> values, int radius,
                                   float depth_tolerance);

}  // namespace nook::bench
