#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace nook {

using glm::dvec3;
using glm::uvec3;
using glm::vec2;
using glm::vec3;

}  // namespace nook
