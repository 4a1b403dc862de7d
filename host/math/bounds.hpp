#pragma once

#include <limits>

#include "math/types.hpp"

namespace nook {

/// An axis-aligned box, world units. Empty (lo > hi) until a point is added.
struct Bounds3 {
  vec3 lo{std::numeric_limits<float>::infinity()};
  vec3 hi{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void add(const vec3& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  void add(const Bounds3& b) {
    lo = glm::min(lo, b.lo);
    hi = glm::max(hi, b.hi);
  }
  vec3 center() const { return vec3((dvec3(lo) + dvec3(hi)) * 0.5); }
  /// Radius of the sphere about center() through the corners: half the diagonal. 0 if empty.
  float bounding_radius() const { return empty() ? 0.0f : float(glm::length(dvec3(hi) - dvec3(lo)) * 0.5); }
};

}  // namespace nook
