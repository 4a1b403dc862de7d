// The warps of warp.cl run alone, on arrays: entry points of host/device/warps.hpp.
#include "sample/warp.cl"

// The order of nook::Warp.
#define WARP_DISK 0u
#define WARP_SPHERE 1u
#define WARP_HEMISPHERE 2u
#define WARP_COSINE_HEMISPHERE 3u
#define WARP_COSINE_POWER 4u

// out[i] = map(u[i]); triples of floats, z = 0 for the disk.
__kernel void warp_map(uint warp, float exponent, __global const float* u, __global float* out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float2 square = vload2(i, u);
  float3 w = (float3)(square_to_disk(square), 0.0f);
  if (warp == WARP_SPHERE) w = square_to_sphere(square);
  if (warp == WARP_HEMISPHERE) w = square_to_hemisphere(square);
  if (warp == WARP_COSINE_HEMISPHERE) w = square_to_cosine_hemisphere(square);
  if (warp == WARP_COSINE_POWER) w = square_to_cosine_power(square, exponent);
  vstore3(w, i, out);
}

// out[i] = the point of the square that map sends to w[i]; pairs of floats.
__kernel void warp_inverse(uint warp, float exponent, __global const float* w, __global float* out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float3 direction = vload3(i, w);
  float2 square = disk_to_square(direction.xy);
  if (warp == WARP_SPHERE) square = sphere_to_square(direction);
  if (warp == WARP_HEMISPHERE) square = hemisphere_to_square(direction);
  if (warp == WARP_COSINE_HEMISPHERE) square = cosine_hemisphere_to_square(direction);
  if (warp == WARP_COSINE_POWER) square = cosine_power_to_square(direction, exponent);
  vstore2(square, i, out);
}

// out[i] = the density of map at w[i].
__kernel void warp_pdf(uint warp, float exponent, __global const float* w, __global float* out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float3 direction = vload3(i, w);
  float pdf = square_to_disk_pdf(direction.xy);
  if (warp == WARP_SPHERE) pdf = square_to_sphere_pdf();
  if (warp == WARP_HEMISPHERE) pdf = square_to_hemisphere_pdf(direction);
  if (warp == WARP_COSINE_HEMISPHERE) pdf = square_to_cosine_hemisphere_pdf(direction);
  if (warp == WARP_COSINE_POWER) pdf = square_to_cosine_power_pdf(direction, exponent);
  out[i] = pdf;
}
