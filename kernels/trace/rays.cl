// A stream of up to 32 rays, and masks of them.
#ifndef NOOK_RAYS_CL
#define NOOK_RAYS_CL

#include "config.h"

typedef struct {
  float x[32], y[32], z[32];
} RayDirections;

// Array by array, which a compiler makes whole vectors of.
void clear_rays(RayDirections* d) {
  for (uint k = 0; k < 32u; ++k) d->x[k] = 0.0f;
  for (uint k = 0; k < 32u; ++k) d->y[k] = 0.0f;
  for (uint k = 0; k < 32u; ++k) d->z[k] = 0.0f;
}

// Rays that a loop over a stream makes together.
#define RAYS_TOGETHER (TRAVERSAL_SCALAR ? 1u : 16u)

// A float3 that a loop over rays keeps in vectors of rays instead.
typedef struct {
  float x, y, z;
} Vector;

Vector ray_vector(const RayDirections* d, uint k) {
  const Vector v = {d->x[k], d->y[k], d->z[k]};
  return v;
}

float3 ray_direction(const RayDirections* d, uint k) { return (float3)(d->x[k], d->y[k], d->z[k]); }

// Index of the lowest set bit; mask != 0.
uint lowest_bit(uint mask) { return 31u - clz(mask & (0u - mask)); }

#endif
