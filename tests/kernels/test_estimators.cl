// The product's samplers, warps and estimators against shapes whose visibility is a formula: no mesh, no tree. What is
// left to go wrong is what ambient.cl and reflection.cl do.
#include "effect/ambient.cl"
#include "config.h"
#include "effect/reflection.cl"
#include "sample/sampler.cl"

// The order of nook::test::Shape.
#define SHAPE_OPEN 0u
#define SHAPE_WALL 1u
#define SHAPE_CEILING_DISK 2u
#define SHAPE_CEILING_SQUARE 3u
#define SHAPE_SPHERE 4u
#define SHAPE_BOX 5u
#define SHAPE_LEANING_PLANE 6u
#define SHAPE_CORNER 7u

// 1 if the ray from `o` along `w` meets no shape within `limit`; the receiver is the plane z = 0, w.z > 0.
float visible(uint shape, float4 s, float3 o, float3 w, float limit) {
  bool hit = false;
  if (shape == SHAPE_WALL && w.x > 0.0f) {  // x = s.x, |y| <= s.y, 0 <= z <= s.z
    float t = (s.x - o.x) / w.x;
    hit = t > 0.0f && t < limit && fabs(o.y + t * w.y) <= s.y && t * w.z <= s.z;
  }
  if (shape == SHAPE_CEILING_DISK || shape == SHAPE_CEILING_SQUARE) {  // z = s.x; radius or half edge s.y
    float t = s.x / w.z, x = o.x + t * w.x, y = o.y + t * w.y;
    bool inside = shape == SHAPE_CEILING_DISK ? hypot(x, y) <= s.y : fmax(fabs(x), fabs(y)) <= s.y;
    hit = t < limit && inside;
  }
  if (shape == SHAPE_SPHERE) {  // centre s.xyz, radius s.w, seen from outside or from inside
    float3 c = s.xyz - o;
    float b = dot(c, w), d = b * b - dot(c, c) + s.w * s.w;
    bool inside = dot(c, c) < s.w * s.w * 1.00001f;
    float t = inside ? b + sqrt(fmax(0.0f, d)) : b - sqrt(fmax(0.0f, d));
    hit = d >= 0.0f && t > 0.0f && t < limit;
  }
  if (shape == SHAPE_BOX) {  // walls |x| = |y| = s.x up to z = s.y
    float t = s.y / w.z;
    hit = fmax(fabs(o.x + t * w.x), fabs(o.y + t * w.y)) > s.x;
  }
  if (shape == SHAPE_LEANING_PLANE) hit = w.x > -s.x * hypot(w.x, w.z);  // up to angle acos(-s.x) from +x, seen along y
  if (shape == SHAPE_CORNER) hit = w.x > 0.0f || w.y > 0.0f;
  return hit ? 0.0f : 1.0f;
}

// Work-item i is one direction, as in test_sampler.cl; values[i] = weight * visibility. `axes` are the receiver's x, y and z
// (its normal) in world coordinates, `view` and the shape are given in those axes. The receiver moves with the camera
// sample by up to half of `footprint` along its x and y.
__kernel void estimate(EstimatorParams p, __global const float* axes, __global const float* view, uint shape, float4 size,
                       float footprint, __global float* values) {
  uint i = get_global_id(0);
  uint direction = i % p.total_directions, camera_sample = i / p.total_directions;
  uint pixel = camera_sample / p.total_samples, sample = camera_sample % p.total_samples;
  float3 x = vload3(0, axes), y = vload3(1, axes), z = vload3(2, axes);
  float2 u = sample_direction(pixel, sample, direction, &p);
  float2 position = sample_pixel(pixel, sample, &p) - 0.5f;
  float3 w = 0.0f;
  float weight;
  if (EFFECT == EFFECT_REFLECTION) {
    float3 v = vload3(0, view);
    weight = reflection_sample(u, z, v.x * x + v.y * y + v.z * z, p.exponent, &w);
  } else {
    weight = ambient_sample(u, z, &w);
  }
  if (weight == 0.0f) {
    values[i] = 0.0f;
    return;
  }
  float3 origin = (float3)(footprint * position, 0.0f), in_axes = (float3)(dot(w, x), dot(w, y), dot(w, z));
  values[i] = weight * visible(shape, size, origin, in_axes, p.max_distance);
}
