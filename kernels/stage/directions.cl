// The directions of a stream of rays and their weights. Where nothing in it branches, a loop over rays is one that a CPU's compiler makes
// 8 or 16 rays at a time of; so what a ray is made from stands in arrays, and what needs calls or loops of its own goes ray by ray.
#ifndef NOOK_DIRECTIONS_CL
#define NOOK_DIRECTIONS_CL

// One ray at a time or 16, the compiler rounds alike.
#pragma OPENCL FP_CONTRACT OFF

#include "effect/ambient.cl"
#include "effect/cone.cl"
#include "config.h"
#include "inline.h"
#include "trace/rays.cl"
#include "effect/reflection.cl"
#include "sample/sampler.cl"

// What each ray's direction is a function of; the fields that the effect does not need are not read.
typedef struct {
  uint pixel[32], sample[32], direction[32], seed[32];  // the random numbers' key, as sample_directions() has it
  float nx[32], ny[32], nz[32];                         // shading normals, unit
  float vx[32], vy[32], vz[32];                         // to the viewer, unit
  float exponent[32];
} RayKeys;

void clear_keys(RayKeys* keys) {
  for (uint k = 0; k < 32u; ++k) {
    keys->pixel[k] = keys->sample[k] = keys->direction[k] = keys->seed[k] = 0u;
    keys->nx[k] = keys->ny[k] = keys->nz[k] = keys->vx[k] = keys->vy[k] = keys->vz[k] = keys->exponent[k] = 0.0f;
  }
}

// Those behind the last ray are made from whatever the keys hold.
#define DIRECTIONS_TOGETHER (TRAVERSAL_SCALAR || (EFFECT == EFFECT_REFLECTION && SAMPLING != SAMPLING_LOBE) ? 1u : 16u)

// One direction at a surface point; returns its weight w with E[w V] the effect's value, 0 if it needs no ray.
INLINE float sample_effect(float2 u, float3 normal, float3 view, float exponent, const EstimatorParams* p, float3* direction) {
  if (EFFECT == EFFECT_REFLECTION) return reflection_sample(u, normal, view, exponent, direction);
  if (CONE) return ambient_cone_sample(u, normal, p->cone_sine, p->cone_cosine, direction);
  return ambient_sample(u, normal, direction);
}

// Directions and weights of the first `count` rays. Returns those for which both are finite; *active: those with a weight above 0 besides.
// In both, the bits behind the first `count` mean nothing.
INLINE uint make_directions(const RayKeys* keys, uint count, const EstimatorParams* p, __global const float* point_set,
                            RayDirections* d, float* weight, uint* active) {
  float ux[32], uy[32];
  for (uint k = 0; k < count; k += RAYS_TOGETHER)
    sample_directions(keys->pixel + k, keys->sample + k, keys->direction + k, keys->seed + k, RAYS_TOGETHER, p, point_set, ux + k,
                      uy + k);
  uint finite = 0, traced = 0;
  for (uint first = 0; first < count; first += DIRECTIONS_TOGETHER)
    for (uint k = first; k < first + DIRECTIONS_TOGETHER; ++k) {
      const float3 normal = (float3)(keys->nx[k], keys->ny[k], keys->nz[k]), view = (float3)(keys->vx[k], keys->vy[k], keys->vz[k]);
      float3 w;
      const float of_ray = sample_effect((float2)(ux[k], uy[k]), normal, view, keys->exponent[k], p, &w);
      d->x[k] = w.x;
      d->y[k] = w.y;
      d->z[k] = w.z;
      weight[k] = of_ray;
      const bool sound = isfinite(of_ray) && isfinite(w.x + w.y + w.z);
      finite |= (uint)sound << k;
      traced |= (uint)(sound && of_ray > 0.0f) << k;
    }
  *active = traced;
  return finite;
}

#endif
