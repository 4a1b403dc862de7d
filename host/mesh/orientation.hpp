#pragma once

#include <algorithm>

#include "math/types.hpp"

namespace nook {

/// The sign of orientation(), by expansions: exact.
int exact_orientation(const dvec2& a, const dvec2& b, const dvec2& c);

/// 1: c lies to the left of the line from a to b; -1: to the right; 0: on it. Exact for all coordinates
/// between 2^-400 and 2^400 and 0: the determinant is taken by its sign if its rounding cannot have changed
/// that, and else in exact arithmetic (Shewchuk, "Adaptive precision floating-point arithmetic and fast
/// robust geometric predicates", 1997, section 4.1; the bound is his ccwerrboundA).
inline int orientation(const dvec2& a, const dvec2& b, const dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  constexpr double half_ulp = 0x1p-53;
  const double bound = (3 + 16 * half_ulp) * half_ulp * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  if (left == 0 && right == 0) return 0;
  return exact_orientation(a, b, c);
}

/// How far p lies from the line through a and b, rounded.
inline double distance_to_line(const dvec2& a, const dvec2& b, const dvec2& p) {
  const dvec2 e = b - a;
  return std::abs(e.x * (p.y - a.y) - e.y * (p.x - a.x)) / std::max(glm::length(e), 1e-300);
}

}  // namespace nook
