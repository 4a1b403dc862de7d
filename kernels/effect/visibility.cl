// V of a stream of directions, as the effect defines it: the tracing that an effect's options ask for, and no more.
//   V(w) = 1 if no surface lies along w between min_distance and max_distance; otherwise, s = t / max_distance for the nearest one at t,
//     FALLOFF_NONE         V = 0
//     FALLOFF_LINEAR       V = s
//     FALLOFF_SMOOTH       V = s² (3 - 2 s)
//     FALLOFF_EXPONENTIAL  V = (1 - e^(-4 s)) / (1 - e^(-4))
// All rise from 0 at contact to 1 at max_distance, so that nothing jumps where an occluder leaves the range (the obscurances of
// Zhukov et al. 1998 and Iones et al. 2003 are of this kind).
#ifndef NOOK_VISIBILITY_CL
#define NOOK_VISIBILITY_CL

#include "config.h"
#include "shared/task.h"
#include "trace/traverse.cl"

float visibility_at(float t, float max_distance) {
  const float s = fmin(t / max_distance, 1.0f);
  if (FALLOFF == FALLOFF_LINEAR) return s;
  if (FALLOFF == FALLOFF_SMOOTH) return s * s * (3.0f - 2.0f * s);
  return -expm1(-4.0f * s) * 1.0186573604f;  // 1 / (1 - e^-4)
}

// The rays of `active` with V > 0. Where FALLOFF asks for it, V itself is written to visibility[k]. `origins` may be moved.
uint visible_rays(BVH_PARAMS, RayDirections* origins, const RayDirections* d, uint active, const EstimatorParams* p,
                  float* visibility) {
  if (MIN_DISTANCE)
    for (uint rest = active; rest; rest &= rest - 1) {
      const uint k = lowest_bit(rest);
      origins->x[k] += p->min_distance * d->x[k];
      origins->y[k] += p->min_distance * d->y[k];
      origins->z[k] += p->min_distance * d->z[k];
    }
  const float limit = MIN_DISTANCE ? p->max_distance - p->min_distance : p->max_distance;
  if (FALLOFF == FALLOFF_NONE) return active & ~occluded_rays(BVH_ARGS, origins, d, active, limit);
  float t[32], u[32], v[32];
  uint triangle[32];
  for (uint k = 0; k < 32u; ++k) t[k] = limit;
  closest_rays(BVH_ARGS, origins, d, active, t, triangle, u, v);
  uint visible = 0;
  for (uint rest = active; rest; rest &= rest - 1) {
    const uint k = lowest_bit(rest);
    const float distance = MIN_DISTANCE ? t[k] + p->min_distance : t[k];
    visibility[k] = triangle[k] == NO_TRIANGLE ? 1.0f : visibility_at(distance, p->max_distance);
    if (visibility[k] > 0.0f) visible |= 1u << k;
  }
  return visible;
}

#endif
