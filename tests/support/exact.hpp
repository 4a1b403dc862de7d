#pragma once

#include "math/types.hpp"

namespace nook::test {

/// A ray's line o + t d (-infinity < t < infinity) and a triangle, decided without rounding.
struct ExactMeeting {
  bool inside = false;   ///< the line goes through the triangle, not through its edges
  double t = 0;          ///< where, to a few roundings of itself; its sign is exact
  double cosine = 0;     ///< between the line and the triangle's normal, 0 to 1
  double shape = 1;      ///< twice the triangle's area over its longest edge squared: small for needles
  double from_edge = 0;  ///< the least distance of the line from the lines of the edges, to a thousandth
};

/// Signs by 512-bit integers (Boost.Multiprecision) where doubles leave them open. Coordinates are multiples
/// of 2^-60 and below 2^24.
ExactMeeting exact_meeting(const vec3& o, const vec3& d, const vec3& a, const vec3& b, const vec3& c);

}  // namespace nook::test
