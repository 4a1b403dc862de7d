#pragma once

#include <algorithm>
#include <cmath>

#include "math/types.hpp"

namespace nook {

/// Where a mesh's coordinates in memory lie in its file's: file = center + 2^exponent memory. Floats have the
/// digits of a scene only near 0 and far from the ends of their range.
struct Frame {
  dvec3 center{0};
  int exponent = 0;

  bool operator==(const Frame&) const = default;
  double to_file(double length) const { return std::ldexp(length, exponent); }
  double from_file(double length) const { return std::ldexp(length, -exponent); }
  dvec3 to_file(const dvec3& p) const { return center + dvec3(to_file(p.x), to_file(p.y), to_file(p.z)); }
  dvec3 from_file(const dvec3& p) const {
    const dvec3 d = p - center;
    return {from_file(d.x), from_file(d.y), from_file(d.z)};
  }
};

/// The frame of a scene within these bounds: the file's own, unless the bounds' middle is more than 16 times
/// as far from 0 as they reach (map coordinates), or their reach is below 2^-20 or from 2^21 on. Ordinary
/// scenes keep their bits; a scaling by a power of two changes none; and the center is a multiple of a power
/// of two of the bounds' size, so that coordinates with few digits keep them.
inline Frame frame_for(const dvec3& lo, const dvec3& hi) {
  const auto largest = [](const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  Frame frame;
  const double half = 0.5 * largest(hi - lo);
  if (!(half > 0) || !std::isfinite(half)) return frame;
  const dvec3 middle = 0.5 * lo + 0.5 * hi;
  if (largest(middle) > 16 * half) {
    const double grid = std::ldexp(1.0, std::ilogb(half) + 1);
    for (int i = 0; i < 3; ++i) frame.center[i] = std::nearbyint(middle[i] / grid) * grid;
  }
  const int exponent = std::ilogb(std::max(largest(lo - frame.center), largest(hi - frame.center)));
  if (std::abs(exponent) > 20) frame.exponent = exponent;
  return frame;
}

}  // namespace nook
