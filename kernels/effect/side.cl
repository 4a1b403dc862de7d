// The side of the surface that occlusion looks to: the shading normal's (SIDE_NORMAL), the other (SIDE_INSIDE), or the viewer's
// (SIDE_VIEWER).
#ifndef NOOK_SIDE_CL
#define NOOK_SIDE_CL

#include "config.h"
#include "trace/intersect.cl"
#include "shared/surface_point.h"
#include "trace/triangle.cl"

bool looks_to_the_other_side(float3 normal, float3 view) {
  if (SIDE == SIDE_INSIDE) return true;
  return SIDE == SIDE_VIEWER && dot(normal, view) < 0.0f;
}

// The point's ray origin on the other side of its triangle: as far from the plane as it was (offset_origin of intersect.cl knows the
// barycentrics), and no nearer than a bound on its own rounding error, 3 gamma(7) times the triangle's largest coordinates. A point
// that the host made is off its surface by `distance` along its normal.
float3 origin_on_other_side(__global const SurfacePoint* point, TRIANGLE_PARAMS, float3 origin, float3 normal) {
  if (point->flags & SURFACE_GIVEN) return origin - 2.0f * point->distance * normal;
  const float3 p0 = vertex(TRIANGLE_ARGS, point->triangle, 0), p1 = vertex(TRIANGLE_ARGS, point->triangle, 1),
               p2 = vertex(TRIANGLE_ARGS, point->triangle, 2);
  const float3 n = (float3)(point->geometric_normal[0], point->geometric_normal[1], point->geometric_normal[2]);
  const float height = dot(origin - p0, n);
  const float3 largest = fmax(fabs(p0), fmax(fabs(p1), fabs(p2)));
  const float away = fmax(fabs(height), 1.251699e-6f * dot(fabs(n), largest));
  return origin - (height + (dot(n, normal) < 0.0f ? -away : away)) * n;
}

#endif
