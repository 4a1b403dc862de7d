// Estimates as integers, whose sums are the same in any order.
#ifndef NOOK_FIXED_POINT_CL
#define NOOK_FIXED_POINT_CL

#include "inline.h"

// The sum below rounds to an integer only as an operation of its own.
#pragma OPENCL FP_CONTRACT OFF

// x to the nearest integer, ties to even; |x| < 2^63, in two's complement. convert_long_rte() is the same, at several times the
// instructions where a processor has none for it. A float has no fraction from 2^23 on.
INLINE ulong to_fixed_point(float x) {
  const float size = fabs(x), nearest = (size + 0x1p23f) - 0x1p23f;
  return as_ulong((long)(size < 0x1p23f ? copysign(nearest, x) : x));
}

#endif
