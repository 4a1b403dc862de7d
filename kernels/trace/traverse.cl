// Visibility and closest-hit queries against the BVH. Bit k or index k of every array is ray k of a stream of up to 32.
//
//   uint occluded_from(BVH_PARAMS, float3 origin, const RayDirections* d, uint active, float max_distance)
//     bit k, of those in `active`: the open segment origin + t d[k], 0 < t < max_distance, meets a triangle.
//   uint occluded_rays(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float max_distance)
//     the same for rays with an origin each.
//   void closest_from(BVH_PARAMS, float3 origin, const RayDirections* d, uint active,
//                     float* t, uint* triangle, float* u, float* v)
//     t[k]: on entry the limit, on return the distance of the first hit; triangle[k]: NO_TRIANGLE for a miss;
//     hit = (1-u-v) p0 + u p1 + v p2. The entries that are not in `active` mean nothing afterwards.
//   void closest_rays(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, ...)
//     the same for rays with an origin each.
//   bool occluded_ray(BVH_PARAMS, float3 o, float3 d, float max_distance)
//   bool closest_ray(BVH_PARAMS, float3 o, float3 d, float* t, uint* triangle, float* u, float* v)
//     one ray: the natural form on a GPU.
//
// Directions are unit length (distances are in units of |d|); origins are finite. max_distance and t may be INFINITY.
// All variants compute the same bits; kernels/config.h chooses by speed: TRAVERSAL_SCALAR.
#ifndef NOOK_TRAVERSE_CL
#define NOOK_TRAVERSE_CL

// With INSTANCES the last two, otherwise the first.
#include "trace/traverse_scalar.cl"
#include "trace/traverse_stream.cl"
#include "trace/traverse_instances.cl"
#include "trace/traverse_instances_scalar.cl"

uint occluded_rays(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  if (!TRAVERSAL_SCALAR) return stream_occluded(BVH_ARGS, origins, d, active, max_distance);
  uint occluded = 0;
  for (uint rest = active; rest; rest &= rest - 1) {
    const uint k = lowest_bit(rest);
    if (occluded_ray(BVH_ARGS, ray_direction(origins, k), ray_direction(d, k), max_distance)) occluded |= 1u << k;
  }
  return occluded;
}

void share_origin(RayDirections* origins, float3 origin) {
  for (uint k = 0; k < 32; ++k) origins->x[k] = origin.x, origins->y[k] = origin.y, origins->z[k] = origin.z;
}

uint occluded_from(BVH_PARAMS, float3 origin, const RayDirections* d, uint active, float max_distance) {
  RayDirections origins;
  share_origin(&origins, origin);
  return occluded_rays(BVH_ARGS, &origins, d, active, max_distance);
}

void closest_of(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, bool shared_origin, float* t,
                uint* triangle, float* u, float* v) {
  if (!TRAVERSAL_SCALAR) {
    stream_closest(BVH_ARGS, origins, d, active, shared_origin, t, triangle, u, v);
    return;
  }
  for (uint rest = active; rest; rest &= rest - 1) {
    const uint k = lowest_bit(rest);
    closest_ray(BVH_ARGS, ray_direction(origins, k), ray_direction(d, k), &t[k], &triangle[k], &u[k], &v[k]);
  }
}

void closest_rays(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float* t, uint* triangle,
                  float* u, float* v) {
  closest_of(BVH_ARGS, origins, d, active, false, t, triangle, u, v);
}

void closest_from(BVH_PARAMS, float3 origin, const RayDirections* d, uint active, float* t, uint* triangle, float* u,
                  float* v) {
  RayDirections origins;
  share_origin(&origins, origin);
  closest_of(BVH_ARGS, &origins, d, active, true, t, triangle, u, v);
}

#endif
