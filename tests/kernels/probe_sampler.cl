// The points of sampler.cl as the device draws them.
#include "sampler.cl"

// Work-item i is one direction: i = (pixel * total_samples + sample) * total_directions + direction, pixels counted from
// first_pixel. directions[i] is its point, positions[pixel * total_samples + sample] that of its camera sample.
__kernel void draw(EstimatorParams p, uint first_pixel, __global float* positions, __global float* directions) {
  uint i = get_global_id(0);
  uint direction = i % p.total_directions, camera_sample = i / p.total_directions;
  uint pixel = first_pixel + camera_sample / p.total_samples, sample = camera_sample % p.total_samples;
  vstore2(sample_direction(pixel, sample, direction, &p), i, directions);
  if (direction == 0u) vstore2(sample_pixel(pixel, sample, &p), camera_sample, positions);
}
