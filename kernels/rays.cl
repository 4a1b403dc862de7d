// A stream of up to 32 rays, and masks of them.
#ifndef NOOK_RAYS_CL
#define NOOK_RAYS_CL

typedef struct {
  float x[32], y[32], z[32];
} RayDirections;

float3 ray_direction(const RayDirections* d, uint k) { return (float3)(d->x[k], d->y[k], d->z[k]); }

// Index of the lowest set bit; mask != 0.
uint lowest_bit(uint mask) { return 31u - clz(mask & (0u - mask)); }

#endif
