// Ray-triangle intersection and ray-box intersection: the arithmetic that every
// traversal shares, for one ray and one triangle. The vector forms of traverse_stream.cl compute the same operations in
// the same order, so that all of them agree to the bit.
#ifndef NOOK_INTERSECT_CL
#define NOOK_INTERSECT_CL

#include "inline.h"
#include "trace/near.cl"
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

// The lesser of |height| and its distance from `far`, where the ray ends.
#define HEIGHT_LEFT(height, far) min_or_second(fabs((height) - (far)), fabs(height))

// Whether the open segment o + t d, 0 < t < max_distance, meets the triangle, from either side; limit_z = max_distance |d[kz]|.
// A triangle without area (det = 0 for every ray) is never met. near_height: NEAR_HEIGHT of the triangle.
bool triangle_occludes(float3 o, float3 d, const RayShear* s, float max_distance, float limit_z, float3 p0, float3 p1, float3 p2,
                       float near_height) {
  const ShearedTriangle t = shear_triangle(o, s, p0, p1, p2);
  if (!inside(&t)) return false;
  const float height = forward_height(&t, s->inverse_z), far = fabs(t.det) * limit_z;
  if (!(far > 0.0f && HEIGHT_LEFT(height, far) <= near_height)) return height > 0.0f && height < far;
  return plane_within(o, d, p0, p1, p2, max_distance);
}

// Up to this number of near_heights, a hit's distance is taken from the plane, so that it is right to a thousandth of itself at worst.
#define NEAR_HITS 1024.0f

// The same with the place: true for 0 < t < *limit; then *limit = t and hit = (1-u-v) p0 + u p1 + v p2.
bool triangle_nearer(float3 o, float3 d, const RayShear* s, float3 p0, float3 p1, float3 p2, float near_height, float* limit, float* u,
                     float* v) {
  const ShearedTriangle f = shear_triangle(o, s, p0, p1, p2);
  if (!inside(&f) || f.det == 0.0f) return false;
  float t = f.height * s->inverse_z / f.det;
  if (fabs(f.height) <= (t < 0.0f ? near_height : NEAR_HITS * near_height)) t = plane_distance(o, d, p0, p1, p2);
  if (!(t > 0.0f && t < *limit)) return false;
  *limit = t;
  *u = f.wb / f.det;
  *v = f.wc / f.det;
  return true;
}

float greater(float a, float b) { return a > b ? a : b; }

#endif
