// Ray-triangle intersection, ray-box intersection and the origins of secondary rays: the arithmetic that every
// traversal shares, one ray and one triangle at a time. The vector forms of traverse_stream.cl compute the same
// operations in the same order, so that all of them agree to the bit.
#ifndef NOOK_INTERSECT_CL
#define NOOK_INTERSECT_CL

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

// a x b. Exchanging or negating operands negates or keeps the result to the bit only as edge_normal() needs it.
float3 cross_fma(float3 a, float3 b) {
  return (float3)(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x)));
}

float dot_fma(float3 a, float3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }

// 2 a x b = (a-b) x (a+b), the normal of the plane through the ray origin and the edge a-b (relative to the origin).
// In this form, exchanging a and b negates every rounding too: the two triangles of an edge see exactly opposite
// values, and no ray passes between them.
float3 edge_normal(float3 a, float3 b) { return cross_fma(a - b, a + b); }

// A triangle against all rays of one origin o: p0, p1, p2 seen from o as a, b, c.
//   A ray along d passes inside when d . (b x c), d . (c x a) and d . (a x b), the Pluecker products of the ray with
//   the edges, have one sign; they are the barycentric weights of p0, p1, p2 up to scale.
//   It meets the plane at t = height / approach, height = a . n, approach = d . n, n = (p1-p0) x (p2-p0).
// Oriented so that height >= 0: then a hit has no negative product, and approach > 0.
typedef struct {
  float3 na, nb, nc;  // twice b x c, c x a, a x b
  float3 n;
  float height;
} OrientedTriangle;

OrientedTriangle orient_triangle(float3 o, float3 p0, float3 p1, float3 p2) {
  const float3 a = p0 - o, b = p1 - o, c = p2 - o;
  const float3 n = cross_fma(a - c, b - a);
  const float height = dot_fma(a, n);
  const float side = height < 0.0f ? -1.0f : 1.0f;
  OrientedTriangle result;
  result.na = side * edge_normal(b, c);
  result.nb = side * edge_normal(c, a);
  result.nc = side * edge_normal(a, b);
  result.n = side * n;
  result.height = side * height;
  return result;
}

// Whether the open segment o + t d, 0 < t < limit, meets the triangle, from either side; inverse_limit = 1/limit,
// 0 if unlimited. Degenerate triangles, and those whose plane holds o, are never met.
bool triangle_occludes(const OrientedTriangle* f, float3 d, float inverse_limit) {
  const float least_approach = f->height > 0.0f ? f->height * inverse_limit : INFINITY;
  return dot_fma(d, f->na) >= 0.0f && dot_fma(d, f->nb) >= 0.0f && dot_fma(d, f->nc) >= 0.0f &&
         dot_fma(d, f->n) > least_approach;
}

// The same with the place: true for 0 < t < *limit; then *limit = t and hit = (1-u-v) p0 + u p1 + v p2.
bool triangle_nearer(const OrientedTriangle* f, float3 d, float* limit, float* u, float* v) {
  const float wa = dot_fma(d, f->na), wb = dot_fma(d, f->nb), wc = dot_fma(d, f->nc);
  const float approach = dot_fma(d, f->n);
  if (!(wa >= 0.0f && wb >= 0.0f && wc >= 0.0f && approach > 0.0f)) return false;
  const float t = f->height / approach;
  if (!(t > 0.0f && t < *limit)) return false;
  const float sum = wa + wb + wc;
  if (!(sum > 0.0f)) return false;
  *limit = t;
  *u = wb / sum;
  *v = wc / sum;
  return true;
}

// Origin for rays that leave the point (1-u-v) p0 + u p1 + v p2 of a triangle: off its plane by a bound on the
// rounding error of that point, gamma(7) sum |b_i p_i| (Pharr, Jakob, Humphreys, pbrt 4th ed., 6.8.6), rounded away.
// geometric_normal: unit; side: >= 0 for the side it points to, < 0 for the other.
float3 offset_origin(float3 p0, float3 p1, float3 p2, float u, float v, float3 geometric_normal, float side) {
  const float w = 1.0f - u - v;
  const float3 point = w * p0 + u * p1 + v * p2;
  const float gamma7 = 4.172328e-7f;  // 7 e / (1 - 7 e), e = 2^-24
  const float3 error = gamma7 * (fabs(w * p0) + fabs(u * p1) + fabs(v * p2));
  const float3 n = side < 0.0f ? -geometric_normal : geometric_normal;
  const float3 offset = dot(fabs(n), error) * n;
  const float3 moved = point + offset;
  const float3 away = select((float3)(-INFINITY), (float3)(INFINITY), offset > 0.0f);
  return select(moved, nextafter(moved, away), offset != 0.0f);
}

#endif
