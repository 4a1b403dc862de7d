// Ray-triangle intersection, ray-box intersection and the origins of secondary rays: the arithmetic that every
// traversal shares, for one ray and one triangle. The vector forms of traverse_stream.cl compute the same operations in
// the same order, so that all of them agree to the bit.
#ifndef NOOK_INTERSECT_CL
#define NOOK_INTERSECT_CL

#include "inline.h"
#include "trace/rays.cl"
#include "shared/bvh.h"

// The compiler must not choose where to fuse: neighbouring triangles have to compute a shared edge alike.
#pragma OPENCL FP_CONTRACT OFF

#define NO_TRIANGLE 0xffffffffu

// Widening of the far slab plane: 1 + 2 gamma, for the roundings of (plane - origin) * (1/d) on both planes
// (Ize, "Robust BVH Ray Traversal", JCGT 2013), where OpenCL lets the division be 2.5 ulp off.
#define FAR_PLANE_GROWTH 1.000001f

// The smaller and larger of two numbers; a NaN in `a` is dropped. (0 * inf occurs where a ray lies in a slab's plane;
// there the slab must not limit the ray.)
float min_or_second(float a, float b) { return a < b ? a : b; }
float max_or_second(float a, float b) { return a > b ? a : b; }

// Entry distance of the ray into a box, or INFINITY if it meets none of it within [0, limit].
// inverse = 1/d; the planes are selected by the sign bit, so that -0 and 0 differ as their inverses do.
float enter_box(float3 lo, float3 hi, float3 o, float3 inverse, float limit) {
  const bool nx = signbit(inverse.x), ny = signbit(inverse.y), nz = signbit(inverse.z);
  float enter = 0.0f, leave = limit;
  enter = max_or_second(((nx ? hi.x : lo.x) - o.x) * inverse.x, enter);
  leave = min_or_second(((nx ? lo.x : hi.x) - o.x) * inverse.x, leave);
  enter = max_or_second(((ny ? hi.y : lo.y) - o.y) * inverse.y, enter);
  leave = min_or_second(((ny ? lo.y : hi.y) - o.y) * inverse.y, leave);
  enter = max_or_second(((nz ? hi.z : lo.z) - o.z) * inverse.z, enter);
  leave = min_or_second(((nz ? lo.z : hi.z) - o.z) * inverse.z, leave);
  return enter <= leave * FAR_PLANE_GROWTH ? enter : INFINITY;
}

// A ray as the watertight triangle test of Woop, Benthin and Wald (JCGT 2013) needs it: z is the axis that d is
// longest along; the shear (x + shear_x z, y + shear_y z) sends the ray to the origin of the xy-plane.
typedef struct {
  uint kx, ky, kz;          // which components are x, y, z; d[kz] may be negative, for the test is two-sided
  float shear_x, shear_y;   // -d[kx]/d[kz], -d[ky]/d[kz]
  float inverse_z;          // 1/d[kz]
} RayShear;

float component(float3 v, uint k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

RayShear shear_ray(float3 d) {
  const float3 size = fabs(d);
  RayShear s;
  s.kz = size.z >= size.x && size.z >= size.y ? 2u : size.y >= size.x ? 1u : 0u;
  s.kx = s.kz == 2 ? 0u : s.kz + 1u;
  s.ky = s.kx == 2 ? 0u : s.kx + 1u;
  s.inverse_z = 1.0f / component(d, s.kz);
  s.shear_x = -(component(d, s.kx) * s.inverse_z);
  s.shear_y = -(component(d, s.ky) * s.inverse_z);
  return s;
}

// Weights wa, wb, wc of the vertices at the ray, all times their sum `det`; t = height / (det d[kz]).
//   wa = c_x b_y - c_y b_x and cyclic, in the sheared plane. Each difference is of two rounded products and has the
//   exact sign or is 0, and two triangles compute the same products for the edge they share: no ray passes between
//   triangles that meet at an edge or a vertex.
typedef struct {
  float wa, wb, wc, det, height;
} ShearedTriangle;

ShearedTriangle shear_triangle(float3 o, const RayShear* s, float3 p0, float3 p1, float3 p2) {
  const float3 a = p0 - o, b = p1 - o, c = p2 - o;
  const float az = component(a, s->kz), bz = component(b, s->kz), cz = component(c, s->kz);
  const float ax = fma(s->shear_x, az, component(a, s->kx)), ay = fma(s->shear_y, az, component(a, s->ky));
  const float bx = fma(s->shear_x, bz, component(b, s->kx)), by = fma(s->shear_y, bz, component(b, s->ky));
  const float cx = fma(s->shear_x, cz, component(c, s->kx)), cy = fma(s->shear_y, cz, component(c, s->ky));
  ShearedTriangle t;
  t.wa = cx * by - cy * bx;
  t.wb = ax * cy - ay * cx;
  t.wc = bx * ay - by * ax;
  t.det = t.wa + t.wb + t.wc;
  t.height = fma(t.wa, az, fma(t.wb, bz, t.wc * cz));
  return t;
}

// All weights have the sign of det (0 has either).
bool inside(const ShearedTriangle* t) {
  return t->det < 0.0f ? t->wa <= 0.0f && t->wb <= 0.0f && t->wc <= 0.0f
                       : t->wa >= 0.0f && t->wb >= 0.0f && t->wc >= 0.0f;
}

// height with the sign of t.
float forward_height(const ShearedTriangle* t, float inverse_z) {
  return (t->det < 0.0f) != signbit(inverse_z) ? -t->height : t->height;
}

float3 leaf_vertex(TREE_LEAF* leaf, uint vertex, uint lane) {
  const uint place = BVH_CORNER(vertex, lane);
  return (float3)(leaf->p[0][place], leaf->p[1][place], leaf->p[2][place]);
}

// Whether the open segment o + t d, 0 < t < max_distance, meets the triangle, from either side; limit_z = max_distance |d[kz]|.
// A triangle without area (det = 0 for every ray) is never met.
bool triangle_occludes(float3 o, const RayShear* s, float limit_z, float3 p0, float3 p1, float3 p2) {
  const ShearedTriangle t = shear_triangle(o, s, p0, p1, p2);
  const float height = forward_height(&t, s->inverse_z);
  return inside(&t) && height > 0.0f && height < fabs(t.det) * limit_z;
}

// The same with the place: true for 0 < t < *limit; then *limit = t and hit = (1-u-v) p0 + u p1 + v p2.
bool triangle_nearer(float3 o, const RayShear* s, float3 p0, float3 p1, float3 p2, float* limit, float* u, float* v) {
  const ShearedTriangle f = shear_triangle(o, s, p0, p1, p2);
  const float t = f.height * s->inverse_z / f.det;
  if (!(inside(&f) && t > 0.0f && t < *limit)) return false;
  *limit = t;
  *u = f.wb / f.det;
  *v = f.wc / f.det;
  return true;
}

float greater(float a, float b) { return a > b ? a : b; }

// The farthest that a, b and c are from x.
float extent_about(float a, float b, float c, float x) { return greater(greater(fabs(a - x), fabs(b - x)), fabs(c - x)); }

// x + offset, and a float on in the offset's direction; x where the offset is 0.
float moved_on(float x, float offset) {
  const float moved = x + offset;
  const int bits = as_int(moved);
  const uint smallest = (as_uint(offset) & 0x80000000u) | 1u;
  const float next = moved == 0.0f ? as_float(smallest) : as_float((moved > 0.0f) == (offset > 0.0f) ? bits + 1 : bits - 1);
  return offset != 0.0f ? next : moved;
}

// Origin for rays that leave the point (1-u-v) p0 + u p1 + v p2 of a triangle: off its plane by a bound on the
// rounding error of that point, gamma(7) sum |b_i p_i| (Pharr, Jakob, Humphreys, pbrt 4th ed., 6.8.6), rounded away, and by what
// the intersection may be off for this triangle: sheared coordinates are products of its extent, and where the point is exactly
// in its plane (a floor at height 0) their roundings alone would decide on which side it lies.
// geometric_normal: unit; side: >= 0 for the side it points to, < 0 for the other.
INLINE void offset_origin(Vector p0, Vector p1, Vector p2, float u, float v, Vector geometric_normal, float side, Vector* origin) {
  const float w = 1.0f - u - v;
  const Vector a = {w * p0.x, w * p0.y, w * p0.z}, b = {u * p1.x, u * p1.y, u * p1.z}, c = {v * p2.x, v * p2.y, v * p2.z};
  const Vector point = {a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z};
  const float gamma7 = 4.172328e-7f;  // 7 e / (1 - 7 e), e = 2^-24
  const float error = gamma7 * (fabs(geometric_normal.x) * (fabs(a.x) + fabs(b.x) + fabs(c.x)) +
                                fabs(geometric_normal.y) * (fabs(a.y) + fabs(b.y) + fabs(c.y)) +
                                fabs(geometric_normal.z) * (fabs(a.z) + fabs(b.z) + fabs(c.z)));
  const float of_intersection =
      9.536743e-7f * greater(greater(extent_about(p0.x, p1.x, p2.x, point.x), extent_about(p0.y, p1.y, p2.y, point.y)),
                             extent_about(p0.z, p1.z, p2.z, point.z));  // 16 e
  const float distance = side < 0.0f ? -(error + of_intersection) : error + of_intersection;
  origin->x = moved_on(point.x, distance * geometric_normal.x);
  origin->y = moved_on(point.y, distance * geometric_normal.y);
  origin->z = moved_on(point.z, distance * geometric_normal.z);
}

#endif
