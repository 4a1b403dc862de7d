#pragma once

#include "math/types.hpp"
#include "scene/scene.hpp"

namespace nook {

/// View space: the eye at the origin, x right, y up, looking along -z; depth = -z, world units.
///
/// Buffers are the image with a guard band of `guard` pixels on each side, in which occluders are seen that
/// the image does not show. Buffer coordinates are continuous, row 0 at the top: the centre of image pixel
/// (x, y) is (guard + x + .5, guard + y + .5). A buffer position q and a depth z > 0 are the view-space point
///   x = z (q ray_scale + ray_offset, -1),
/// which for guard = 0 are the camera rays (kernels/sample/camera.cl).
struct SsaoView {
  vec3 eye{0}, right{1, 0, 0}, up{0, 1, 0}, backward{0, 0, 1};  ///< world; the last three unit and orthogonal
  int width = 0, height = 0;                                    ///< of the image, pixels
  int guard = 0;                                                ///< pixels on each side
  vec2 ray_scale{1}, ray_offset{0};

  int buffer_width() const { return width + 2 * guard; }
  int buffer_height() const { return height + 2 * guard; }

  vec3 to_view(const vec3& world) const;
  vec3 to_world(const vec3& view) const;
  vec3 direction_to_world(const vec3& view) const;
  /// Buffer coordinates of a view-space point; only meaningful for depth > 0.
  vec2 project(const vec3& view) const;
  /// The view-space point at buffer coordinates and depth.
  vec3 reconstruct(const vec2& buffer, float depth) const;
};

/// Throws Error(scene) if the camera has no direction (eye = at) or up is along it.
SsaoView make_ssao_view(const Camera& camera, int width, int height, int guard);

}  // namespace nook
