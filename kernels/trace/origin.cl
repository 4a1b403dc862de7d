// Where rays start that leave a surface: as near to it as the rounding of the point allows, and surely on the side they look to.
// What may be off is the point and not the triangle, which may be a million times as large as what is of interest on it; so the point is
// computed in pairs of floats, once, and the triangle itself is not met again: plane_distance() (near.cl) has the origin's side right.
#ifndef NOOK_ORIGIN_CL
#define NOOK_ORIGIN_CL

#include "inline.h"
#include "trace/intersect.cl"
#include "trace/near.cl"
#include "trace/rays.cl"

float lesser(float a, float b) { return a < b ? a : b; }

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

// A coordinate of p0 + u (p1 - p0) + v (p2 - p0), to 2^-45 of the triangle's extent, where barycentrics that are rounded leave no trace
// in the distance from the plane.
INLINE void point_between(float p0, float p1, float p2, float u, float v, TwoFloats* point) {
  const TwoFloats of_u = {u, 0.0f}, of_v = {v, 0.0f}, from = {p0, 0.0f};
  TwoFloats e, f, a, b, ab;
  exact_difference(p1, p0, &e);
  exact_difference(p2, p0, &f);
  multiply_two(of_u, e, &a);
  multiply_two(of_v, f, &b);
  add_two(a, b, &ab);
  add_two(from, ab, point);
}

// How far eye + t d is from a point, along one axis: to a half ulp of t, and of eye - point where that is less exact.
INLINE float from_point(TwoFloats point, float eye, float d, float t) { return fma(t, d, (eye - point.hi) - point.lo); }

// How far a point is moved off its triangle's plane, a distance along `normal` (unit): four half ulps of its coordinates, for rounding
// it and what is added to it; and what keeps a ray from coming near its own triangle again, for the time that takes: as much as the
// float test may be off for a triangle of this extent, but no more than 16 half ulps of the point or of the distance it is seen from.
// 2^-40 of the extent is what plane_distance() may be off.
INLINE float distance_off(Vector point, Vector normal, float extent, float seen_from) {
  const float x = fabs(point.x), y = fabs(point.y), z = fabs(point.z);
  const float rounding = 2.384186e-7f * (fabs(normal.x) * x + fabs(normal.y) * y + fabs(normal.z) * z);
  return rounding + 9.536743e-7f * lesser(extent, greater(greater(greater(x, y), z), seen_from)) + 9.094947e-13f * extent;
}

// Triangles that are larger than this multiple of the distance from the eye: there barycentrics place a point worse than the ray does.
#define GIANT_EXTENT 4096.0f

// Origin for rays that leave the point (1-u-v) p0 + u p1 + v p2 of a triangle, which eye + t d meets there.
// geometric_normal: unit; side: >= 0 for the side it points to, < 0 for the other.
INLINE void offset_origin(Vector p0, Vector p1, Vector p2, float u, float v, Vector geometric_normal, float side, Vector eye, Vector d,
                          float t, Vector* origin) {
  const Vector n = geometric_normal;
  TwoFloats x, y, z;
  point_between(p0.x, p1.x, p2.x, u, v, &x);
  point_between(p0.y, p1.y, p2.y, u, v, &y);
  point_between(p0.z, p1.z, p2.z, u, v, &z);
  const float extent = greater(greater(extent_about(p0.x, p1.x, p2.x, x.hi), extent_about(p0.y, p1.y, p2.y, y.hi)),
                               extent_about(p0.z, p1.z, p2.z, z.hi));
  // The way to the ray's own point, within the plane.
  const float rx = from_point(x, eye.x, d.x, t), ry = from_point(y, eye.y, d.y, t), rz = from_point(z, eye.z, d.z, t);
  const float away = rx * n.x + ry * n.y + rz * n.z;
  const bool giant = extent > GIANT_EXTENT * t;
  const Vector point = {giant ? x.hi + (x.lo + (rx - away * n.x)) : x.hi, giant ? y.hi + (y.lo + (ry - away * n.y)) : y.hi,
                        giant ? z.hi + (z.lo + (rz - away * n.z)) : z.hi};
  const float off = distance_off(point, n, extent, t), distance = side < 0.0f ? -off : off;
  origin->x = moved_on(point.x, distance * n.x);
  origin->y = moved_on(point.y, distance * n.y);
  origin->z = moved_on(point.z, distance * n.z);
}

#endif
