// The points of sampler.cl as the device draws them.
#include "sample/sampler.cl"

// Work-item i is one direction: i = (pixel * total_samples + sample) * total_directions + direction, pixels counted from
// first_pixel. directions[i] is its point, drawn together with the 15 beside it, positions[pixel * total_samples + sample] that of its
// camera sample.
__kernel void draw(EstimatorParams p, uint first_pixel, __global float* positions, __global float* directions) {
  const uint i = get_global_id(0), lane = i % 16u, last = get_global_size(0) - 1u;
  uint pixel[16], sample[16], direction[16], seed[16];
  for (uint k = 0; k < 16u; ++k) {
    const uint number = min(i - lane + k, last), camera_sample = number / p.total_directions;
    direction[k] = number % p.total_directions;
    sample[k] = camera_sample % p.total_samples;
    seed[k] = p.seed;
    pixel[k] = first_pixel + camera_sample / p.total_samples;
  }
  float x[16], y[16];
  sample_directions(pixel, sample, direction, seed, 16u, &p, 0, x, y);
  vstore2((float2)(x[lane], y[lane]), i, directions);
  if (direction[lane] == 0u) vstore2(sample_pixel(pixel[lane], sample[lane], &p), i / p.total_directions, positions);
}
