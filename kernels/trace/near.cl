// Triangles that a ray's origin lies near, for their size. The float test's height (intersect.cl) is a sum of products of a triangle's
// extents, and where it is less than their rounding, neither its sign nor the distance means anything. There the plane is met in
// pairs of floats instead: the exact differences of the corners and the origin, and products and sums of twice a float's digits
// (Dekker 1971, "A Floating-Point Technique for Extending the Available Precision"; Shewchuk 1997). What is inside
// which triangle remains the float test's matter, which leaves no gaps.
#ifndef NOOK_NEAR_CL
#define NOOK_NEAR_CL

#include "inline.h"
#include "shared/bvh.h"

// Where a product and a sum are one or two operations decides what is lost.
#pragma OPENCL FP_CONTRACT OFF

// hi + lo, |lo| <= half an ulp of hi.
typedef struct {
  float hi, lo;
} TwoFloats;

// a + b and a - b, exactly (Knuth).
INLINE void exact_sum(float a, float b, TwoFloats* sum) {
  const float hi = a + b, of_b = hi - a;
  sum->hi = hi;
  sum->lo = (a - (hi - of_b)) + (b - of_b);
}
INLINE void exact_difference(float a, float b, TwoFloats* difference) { exact_sum(a, -b, difference); }

// a b, exactly where it does not underflow.
INLINE void exact_product(float a, float b, TwoFloats* product) {
  const float hi = a * b;
  product->hi = hi;
  product->lo = fma(a, b, -hi);
}

// To about 2^-45 of |a| + |b|, and of |a b|.
INLINE void add_two(TwoFloats a, TwoFloats b, TwoFloats* sum) {
  TwoFloats s;
  exact_sum(a.hi, b.hi, &s);
  exact_sum(s.hi, s.lo + (a.lo + b.lo), sum);
}
INLINE void multiply_two(TwoFloats a, TwoFloats b, TwoFloats* product) {
  TwoFloats p;
  exact_product(a.hi, b.hi, &p);
  exact_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi), product);
}
// a b - c d
INLINE void cross_two(TwoFloats a, TwoFloats b, TwoFloats c, TwoFloats d, TwoFloats* difference) {
  TwoFloats ab, cd;
  multiply_two(a, b, &ab);
  multiply_two(c, d, &cd);
  cd.hi = -cd.hi, cd.lo = -cd.lo;
  add_two(ab, cd, difference);
}
INLINE void dot_two(const TwoFloats* a, const TwoFloats* b, TwoFloats* sum) {
  TwoFloats x, y, z, xy;
  multiply_two(a[0], b[0], &x);
  multiply_two(a[1], b[1], &y);
  multiply_two(a[2], b[2], &z);
  add_two(x, y, &xy);
  add_two(xy, z, sum);
}

void difference_of(float3 a, float3 b, TwoFloats* difference) {
  exact_difference(a.x, b.x, &difference[0]);
  exact_difference(a.y, b.y, &difference[1]);
  exact_difference(a.z, b.z, &difference[2]);
}

// (b - a) x (c - a), as long as twice the triangle's area.
void normal_two(float3 a, float3 b, float3 c, TwoFloats* n) {
  TwoFloats u[3], v[3];
  difference_of(b, a, u);
  difference_of(c, a, v);
  cross_two(u[1], v[2], u[2], v[1], &n[0]);
  cross_two(u[2], v[0], u[0], v[2], &n[1]);
  cross_two(u[0], v[1], u[1], v[0], &n[2]);
}

// t where o + t d meets the plane of a triangle: n . (a - o) / n . d. Negative if it runs along the plane. The sign is right down to
// 2^-40 of the triangle's extent.
float plane_distance(float3 o, float3 d, float3 a, float3 b, float3 c) {
  TwoFloats n[3], q[3], height, approach;
  normal_two(a, b, c, n);
  difference_of(a, o, q);
  dot_two(n, q, &height);
  const TwoFloats along[3] = {{d.x, 0.0f}, {d.y, 0.0f}, {d.z, 0.0f}};
  dot_two(n, along, &approach);
  return approach.hi == 0.0f ? -1.0f : height.hi / approach.hi;
}

// The same of all axes at once: a - b = *rounded + what is returned.
INLINE float3 lost_of_difference(float3 a, float3 b, float3* rounded) {
  const float3 hi = a - b, of_b = hi - a;
  *rounded = hi;
  return (a - (hi - of_b)) - (b + of_b);
}

// a b - c d to 1.5 units in its last place (Kahan; Jeannerod, Louvet, Muller, Math. Comp. 2013).
INLINE float3 difference_of_products(float3 a, float3 b, float3 c, float3 d) {
  const float3 cd = c * d;
  return fma(a, b, -cd) - fma(c, d, -cd);
}

// Whether 0 < plane_distance() < max_distance. In floats first: the normal of the exact edges, to 4 units in its last place and 2^-44 of
// their products; height and approach with it, to 10 half ulps of their terms. Pairs of floats tell where that leaves it open.
bool plane_within(float3 o, float3 d, float3 a, float3 b, float3 c, float max_distance) {
  float3 u, v, q;
  const float3 of_u = lost_of_difference(b, a, &u), of_v = lost_of_difference(c, a, &v), of_q = lost_of_difference(a, o, &q);
  const float3 n = difference_of_products(u.yzx, v.zxy, u.zxy, v.yzx) +
                   ((u.yzx * of_v.zxy + of_u.yzx * v.zxy) - (u.zxy * of_v.yzx + of_u.zxy * v.yzx));
  const float3 h = n * q, along = n * d;
  const float3 size_h = fabs(h), size_a = fabs(along), size_u = fabs(u), size_v = fabs(v), size_q = fabs(q), more = n * of_q;
  const float lost = 1.1368684e-13f * (size_u.x + size_u.y + size_u.z) * (size_v.x + size_v.y + size_v.z) + 7.8886091e-31f;
  const float height = (h.x + h.y + h.z) + (more.x + more.y + more.z), approach = along.x + along.y + along.z;
  const float off_height = 5.9604645e-7f * (size_h.x + size_h.y + size_h.z) + lost * (1.0f + size_q.x + size_q.y + size_q.z);
  const float off_approach = 5.9604645e-7f * (size_a.x + size_a.y + size_a.z) + 2.0f * lost;
  const float sure_approach = fabs(approach) - off_approach;
  if (fabs(height) > off_height && sure_approach > 0.0f) {
    if ((height < 0.0f) != (approach < 0.0f)) return false;
    if (fabs(height) + off_height < max_distance * sure_approach) return true;
  }
  const float t = plane_distance(o, d, a, b, c);
  return t > 0.0f && t < max_distance;
}

#endif
