#pragma once

#include <cstring>
#include <limits>

#include "math/types.hpp"

namespace nook {

/// Four floats in one register: x, y, z and a lane that nobody reads.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

inline Float4 min4(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 max4(Float4 a, Float4 b) {
  return a > b ? a : b;
}

inline vec3 xyz(Float4 v) {
  return {v[0], v[1], v[2]};
}

/// A Bounds3 in two registers, to which NaN is never added.
struct Box4 {
  Float4 lo, hi;

  static Box4 empty() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Float4{} + infinity, Float4{} - infinity};
  }

  void add(Float4 low, Float4 high) {
    lo = min4(lo, low);
    hi = max4(hi, high);
  }
  void add(const Box4& b) { add(b.lo, b.hi); }
  float half_area() const {
    const Float4 e = hi - lo;
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
};

}  // namespace nook
