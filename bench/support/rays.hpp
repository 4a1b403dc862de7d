#pragma once

#include <array>
#include <vector>

#include "bench/embree/embree_scene.hpp"
#include "bench/support/bench_scene.hpp"

namespace nook::bench {

/// A point that occlusion rays leave, and the axis their directions are drawn about: the normal (AO) or the
/// mirrored view (RO). Directions under the normal's horizon are not traced.
struct RayPoint {
  vec3 origin;
  vec3 axis;
  vec3 normal;
};

/// Directions in the frame of the axis (z), in sets of `size`; point i uses set set_of_point(i).
/// The same table feeds our kernel and Embree: both turn it into the point's frame by the same operations, so
/// that both trace the same rays to the bit.
struct DirectionSets {
  static constexpr unsigned count = 256;
  unsigned size = 16;
  std::vector<vec3> directions;  // [set * size + k], unit length
};

/// Cosine-distributed for exponent 1; cos^n for others. Stratified by a rank-1 lattice, shifted for each set.
DirectionSets direction_sets(unsigned size, float exponent);

inline unsigned set_of_point(unsigned i) {
  i = (i ^ (i >> 16)) * 0x7feb352du;
  i = (i ^ (i >> 15)) * 0x846ca68bu;
  return (i ^ (i >> 16)) & (DirectionSets::count - 1);
}

/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017; the kernel computes the same
/// operations.
inline std::array<vec3, 2> tangents(const vec3& n) {
  const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  return {vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y)};
}

inline vec3 to_world(const vec3& d, const std::array<vec3, 2>& t, const vec3& n) {
  return {d.x * t[0].x + d.y * t[1].x + d.z * n.x, d.x * t[0].y + d.y * t[1].y + d.z * n.y,
          d.x * t[0].z + d.y * t[1].z + d.z * n.z};
}

/// Camera rays' directions, `samples` to a pixel (a regular pattern), pixels in tiles of 8 x 8.
std::vector<vec3> camera_directions(const BenchScene& scene, unsigned resolution, unsigned samples);

/// The points that those rays see, on the viewer's side of the surface. A ray that misses has no point.
/// mirrored: the axis is the view's mirror direction instead of the normal.
std::vector<RayPoint> visible_points(const BenchScene& scene, const EmbreeScene& embree,
                                     const std::vector<vec3>& directions, bool mirrored);

}  // namespace nook::bench
