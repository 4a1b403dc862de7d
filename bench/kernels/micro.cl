// The warps and samplers by themselves: each work-item evaluates one of them `repeats` times and keeps the sum, so that
// nothing is left out and memory plays no part. MICRO_WARP, the order of nook::Warp, and SAMPLER choose.
#include "sample/sampler.cl"
#include "sample/warp.cl"

#ifndef MICRO_WARP
#define MICRO_WARP 3
#endif

float2 next_point(uint* state) {
  *state = *state * 1664525u + 1013904223u;
  const uint x = *state;
  *state = *state * 1664525u + 1013904223u;
  return (float2)(uint_to_unit_float(x), uint_to_unit_float(*state));
}

float3 map(float2 u, float exponent) {
  if (MICRO_WARP == 0) return (float3)(square_to_disk(u), 0.0f);
  if (MICRO_WARP == 1) return square_to_sphere(u);
  if (MICRO_WARP == 2) return square_to_hemisphere(u);
  if (MICRO_WARP == 3) return square_to_cosine_hemisphere(u);
  return square_to_cosine_power(u, exponent);
}

float2 inverse(float3 w, float exponent) {
  if (MICRO_WARP == 0) return disk_to_square(w.xy);
  if (MICRO_WARP == 1) return sphere_to_square(w);
  if (MICRO_WARP == 2) return hemisphere_to_square(w);
  if (MICRO_WARP == 3) return cosine_hemisphere_to_square(w);
  return cosine_power_to_square(w, exponent);
}

float pdf(float3 w, float exponent) {
  if (MICRO_WARP == 0) return square_to_disk_pdf(w.xy);
  if (MICRO_WARP == 1) return square_to_sphere_pdf();
  if (MICRO_WARP == 2) return square_to_hemisphere_pdf(w);
  if (MICRO_WARP == 3) return square_to_cosine_hemisphere_pdf(w);
  return square_to_cosine_power_pdf(w, exponent);
}

// What the others pay for their points.
__kernel void points_alone(uint repeats, float exponent, __global float* out) {
  const uint id = get_global_id(0);
  uint state = pcg(id);
  float2 sum = (float2)(0.0f);
  for (uint i = 0; i < repeats; ++i) sum += next_point(&state);
  out[id] = sum.x + sum.y + exponent;
}

__kernel void warp_map(uint repeats, float exponent, __global float* out) {
  const uint id = get_global_id(0);
  uint state = pcg(id);
  float3 sum = (float3)(0.0f);
  for (uint i = 0; i < repeats; ++i) sum += map(next_point(&state), exponent);
  out[id] = sum.x + sum.y + sum.z;
}

__kernel void warp_map_inverse(uint repeats, float exponent, __global float* out) {
  const uint id = get_global_id(0);
  uint state = pcg(id);
  float2 sum = (float2)(0.0f);
  for (uint i = 0; i < repeats; ++i) sum += inverse(map(next_point(&state), exponent), exponent);
  out[id] = sum.x + sum.y;
}

__kernel void warp_map_pdf(uint repeats, float exponent, __global float* out) {
  const uint id = get_global_id(0);
  uint state = pcg(id);
  float sum = 0.0f;
  for (uint i = 0; i < repeats; ++i) sum += pdf(map(next_point(&state), exponent), exponent);
  out[id] = sum;
}

// One camera sample of pixel `id`, `repeats` directions, 16 at a time as `occlusion` makes them.
__kernel void sampler_directions(uint repeats, float seed, __global float* out) {
  const uint id = get_global_id(0);
  EstimatorParams p;
  p.total_samples = 16;
  p.total_directions = repeats;
  p.seed = (uint)seed;
  p.width = 1024;
  float2 sum = (float2)(0.0f);
  uint pixels[16], samples[16], directions[16], seeds[16];
  for (uint k = 0; k < 16u; ++k) pixels[k] = id, samples[k] = 3, seeds[k] = p.seed;
  for (uint i = 0; i < repeats; i += 16u) {
    float x[16], y[16];
    for (uint k = 0; k < 16u; ++k) directions[k] = i + k;
    sample_directions(pixels, samples, directions, seeds, 16u, &p, 0, x, y);
    for (uint k = 0; k < 16u; ++k) sum += (float2)(x[k], y[k]);
  }
  out[id] = sum.x + sum.y;
}
