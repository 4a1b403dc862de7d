#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook::bench {

/// What the camera sees through the centre of one pixel, by exact ray casting.
struct PrimaryHit {
  bool hit = false;
  vec3 position{0}, shading_normal{0}, geometric_normal{0};  ///< world; normals unit, never flipped
};

/// Ray-traced AO as the yardstick for SSAO, by Embree (ROBUST), not by nook's own kernels: same distance,
/// weighting and shading normals.
class ReferenceTracer {
 public:
  explicit ReferenceTracer(const TriangleMesh& mesh);
  ~ReferenceTracer();
  ReferenceTracer(const ReferenceTracer&) = delete;
  ReferenceTracer& operator=(const ReferenceTracer&) = delete;

  /// Through pixel centres of the image with `guard` = 0; pixels are y * width + x.
  std::vector<PrimaryHit> primary(const Camera& camera, int width, int height,
                                  const std::vector<std::uint32_t>& pixels) const;

  struct Estimate {
    float value = 0;     ///< AO; 0 for a miss
    float variance = 0;  ///< of the value; an unbiased estimate from its two halves
  };
  /// Cosine-weighted AO from two independent halves of grid * grid directions each, jittered in their strata;
  /// on all cores.
  std::vector<Estimate> ambient(const std::vector<PrimaryHit>& hits, float radius, int grid,
                                std::uint64_t seed) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nook::bench
