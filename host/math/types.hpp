#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace nook {

using glm::dvec2;
using glm::dvec3;
using glm::uvec3;
using glm::vec2;
using glm::vec3;

inline bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace nook
