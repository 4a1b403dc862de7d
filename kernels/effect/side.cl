// The side of the surface that occlusion looks to: the shading normal's (SIDE_NORMAL), the other (SIDE_INSIDE), or the viewer's
// (SIDE_VIEWER).
#ifndef NOOK_SIDE_CL
#define NOOK_SIDE_CL

#include "config.h"
#include "trace/origin.cl"
#include "shared/surface_point.h"
#include "trace/triangle.cl"

// The viewer sees a side of the triangle: near silhouettes a shading normal may face away that is on the viewer's side all the same.
bool looks_to_the_other_side(__global const SurfacePoint* point, float3 normal, float3 view) {
  if (SIDE == SIDE_INSIDE) return true;
  if (SIDE != SIDE_VIEWER) return false;
  if (point->flags & SURFACE_GIVEN) return dot(normal, view) < 0.0f;
  const float3 n = (float3)(point->geometric_normal[0], point->geometric_normal[1], point->geometric_normal[2]);
  return dot(n, view) * dot(n, normal) < 0.0f;
}

// The point's ray origin on the other side of its triangle: as far from the plane as it was, and no nearer than distance_off(). A point
// that the host made is off its surface by `distance` along its normal.
float3 origin_on_other_side(__global const SurfacePoint* point, TRIANGLE_PARAMS, float3 origin, float3 normal) {
  if (point->flags & SURFACE_GIVEN) {
    const float3 back = -2.0f * point->distance * normal;
    return (float3)(moved_on(origin.x, back.x), moved_on(origin.y, back.y), moved_on(origin.z, back.z));
  }
  const float3 p0 = vertex(TRIANGLE_ARGS, point->triangle, 0), p1 = vertex(TRIANGLE_ARGS, point->triangle, 1),
               p2 = vertex(TRIANGLE_ARGS, point->triangle, 2);
  const float3 n = (float3)(point->geometric_normal[0], point->geometric_normal[1], point->geometric_normal[2]);
  const float height = -plane_distance(origin, n, p0, p1, p2);
  const Vector at = {origin.x, origin.y, origin.z}, along = {n.x, n.y, n.z};
  const float extent = greater(greater(extent_about(p0.x, p1.x, p2.x, at.x), extent_about(p0.y, p1.y, p2.y, at.y)),
                               extent_about(p0.z, p1.z, p2.z, at.z));
  const float away = fmax(fabs(height), distance_off(at, along, extent, point->distance));
  const float3 back = -(height + (dot(n, normal) < 0.0f ? -away : away)) * n;
  return (float3)(moved_on(origin.x, back.x), moved_on(origin.y, back.y), moved_on(origin.z, back.z));
}

#endif
