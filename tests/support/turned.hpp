#pragma once

#include <cmath>

#include "math/types.hpp"

namespace nook::test {

/// A rotation by 1.1 radians about an axis of no symmetry: what it turns lies askew of the world's axes.
inline const glm::dmat3 turned = [] {
  const dvec3 axis = glm::normalize(dvec3(0.3, -0.4, 0.2));
  const double c = std::cos(1.1), s = std::sin(1.1);
  glm::dmat3 m;
  for (int i = 0; i < 3; ++i) {
    dvec3 e(0);
    e[i] = 1;
    m[i] = c * e + s * glm::cross(axis, e) + (1 - c) * glm::dot(axis, e) * axis;
  }
  return m;
}();

}  // namespace nook::test
