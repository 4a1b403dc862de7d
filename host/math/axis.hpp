#pragma once

#include "math/types.hpp"

namespace nook {

/// An axis of the world, or its opposite.
enum class Axis { x, y, z, minus_x, minus_y, minus_z };

/// 0, 1 or 2.
constexpr int number_of(Axis axis) {
  return int(axis) % 3;
}
constexpr bool is_opposite(Axis axis) {
  return axis >= Axis::minus_x;
}
inline dvec3 direction_of(Axis axis) {
  dvec3 direction(0);
  direction[number_of(axis)] = is_opposite(axis) ? -1 : 1;
  return direction;
}

/// The axis nearest to a direction; y of several that are as near.
inline Axis nearest_axis(const vec3& v) {
  int axis = 1;
  for (const int other : {2, 0})
    if (std::abs(v[other]) > std::abs(v[axis])) axis = other;
  return Axis(axis + (v[axis] < 0 ? 3 : 0));
}

}  // namespace nook
