#pragma once

#include "math/bounds.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The numbers behind a method and a quality; docs/ssao.md says what each was measured to bring.
struct SsaoPlan {
  SsaoSettings::Method method = SsaoSettings::Method::point;
  float radius = 0.15f;      ///< world units
  float bias = 0;            ///< point: world units
  bool range_check = false;  ///< point
  bool cosine = false;       ///< point: cosine-weighted directions instead of the assignment's uniform ones
  bool as_published =
      false;            ///< point: independent directions, and the sum clamped to 1 (compat = "tinyrender")
  int directions = 32;  ///< point, march: directions a pixel; gtao: slices, two directions each
  int steps = 1;        ///< march (at least 2), gtao: steps along a direction
  int layers = 1;  ///< 1: the front, 2: with the nearest back face, more: that number of faces along each
                   ///< pixel's view ray
  float thickness = 0;  ///< more than two layers: of sheets, and of solids at least; a share of the radius
  bool half_resolution = false;   ///< shade every other pixel of every other row, then upsample
  int denoise_radius = 0;         ///< pixels of the shaded image; 0: no denoiser
  float depth_tolerance = 0.01f;  ///< denoiser, upsample: how far off the tangent plane a neighbour may be,
                                  ///< as a share of its depth
  float normal_tolerance = 0;     ///< denoiser: 1 - cos of the angle at which a neighbour's normal no longer
                                  ///< counts; 0: any normal does
  float guard = 0;                ///< guard band on each side, at most this share of the image's height

  bool operator==(const SsaoPlan&) const = default;
};

/// bounds: of the mesh, for radius 0 (half the radius of the bounding sphere).
/// Throws Error(scene) for a sample count outside 1 to 32 or a radius or bias that is negative or not finite.
SsaoPlan plan_ssao(const SsaoSettings& settings, const Bounds3& bounds);

}  // namespace nook
