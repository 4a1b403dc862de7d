// The random numbers of an estimate: pure functions of (pixel, sample, direction, seed), the same for every tiling,
// order and split of the work. SAMPLER chooses the point set.
//
// A pixel has N = total_samples camera samples, and each has D = total_directions directions, numbered i = sample * D +
// direction. Every point is uniform in [0,1)² over seeds, whatever N and D; powers of two stratify best.
//   independent  a hash of (pixel, sample, direction, seed): no stratification, the safe choice for statistical tests
//   stratified   multi-jittered over the N camera samples and, apart, over the N D directions
//   halton       bases 2 and 3 for direction i, 5 and 7 for camera sample i / D
//   sobol        dimensions 0 and 1, the best pair, for direction i; 2 and 3 for the camera sample. With D = 1 they make
//                one point of a 4D net; with D > 1 the directions of a camera sample are an aligned block, so both
//                each block and the union of blocks are stratified
//   zorder       the same points, but one sequence for the whole image, dealt to pixels in a scrambled Z-order:
//                neighbouring pixels continue each other's net and their errors repel (Ahmed and Wonka 2020,
//                "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels")
//   points       a set of D points that is given, for point lists: the same for every row, shifted by a vector of its own
//                modulo 1 (Cranley and Patterson 1976), or as it is (POINTS_AS_THEY_ARE)
#ifndef NOOK_SAMPLER_CL
#define NOOK_SAMPLER_CL

#include "config.h"
#include "sample/halton.cl"
#include "inline.h"
#include "sample/random.cl"
#include "shared/task.h"
#include "sample/sobol.cl"
#include "sample/stratified.cl"

// What the hashes are keyed with besides (pixel, seed), so that no two uses share random numbers.
#define STREAM_SOBOL 0x536f626fu
#define STREAM_HALTON 0x48616c74u
#define STREAM_STRATIFIED 0x53747261u
#define STREAM_ZORDER 0x5a6f7264u
#define STREAM_POINTS 0x506f696eu
#define CAMERA_DIRECTION 0xffffffffu  // the direction index that stands for the camera sample itself

// With one camera sample a pixel, tasks may have seeds of their own (Task.first_sample).
#define SEED(k) (REPLICATE_DIRECTIONS ? seed[k] : p->seed)

// The low 16 bits of x, each with a 0 above it.
uint spread_bits(uint x) {
  x &= 0xffffu;
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

// Interleaves the low 16 bits of x and y: x in the even bits.
uint morton_code(uint x, uint y) { return spread_bits(x) | spread_bits(y) << 1; }

// The sequence's index for point i < count of `pixel`. Each pixel owns an aligned block of 2^bits indices, bits = ceil(log2 count);
// shuffling the children of every quadtree node independently is a nested scramble of the Z-order code. The scramble
// goes on through the point's own bits: were they left in order and count no power of two, every pixel would miss the
// same part of the square. An image with more pixels than blocks repeats; *tile then tells the repetitions apart.
INLINE uint zorder_index(uint pixel, uint i, uint count, uint width, uint seed, uint* tile) {
  uint columns = width > 0u ? width : 1u;
  uint code = width > 0u ? morton_code(pixel % columns, pixel / columns) : pixel;
  uint bits = 32u - clz(count - 1u);
  ulong place = (ulong)code << bits;  // of the pixel's block, and above it the repetition
  *tile = (uint)(place >> 32);
  uint index = (uint)place | i;
  return reverse_bits(owen_scramble_reversed(reverse_bits(index), pcg(seed ^ STREAM_ZORDER)));
}

// x + y modulo 1, of multiples of 2^-24 in [0,1): exact.
float sum_modulo_1(float x, float y) {
  const float rest = 1.0f - y;
  return x >= rest ? x - rest : x + y;
}

// Where camera sample `sample` lies in its pixel, in [0,1)²: the centre if it is the only one.
INLINE float2 sample_pixel(uint pixel, uint sample, const EstimatorParams* p) {
  float2 u = (float2)(0.5f);
  if (SAMPLER == SAMPLER_INDEPENDENT) {
    uint4 h = pcg4d(pixel, sample, CAMERA_DIRECTION, p->seed);
    u.x = uint_to_unit_float(h.x);
    u.y = uint_to_unit_float(h.y);
  }
  if (SAMPLER == SAMPLER_STRATIFIED) {
    uint key = pcg4d(pixel, p->seed, STREAM_STRATIFIED, 0u).x;
    float x, y;
    stratified_point(&sample, &key, 1u, p->total_samples, &x, &y);
    u.x = x;
    u.y = y;
  }
  if (SAMPLER == SAMPLER_HALTON) {
    uint4 key = pcg4d(pixel, p->seed, STREAM_HALTON, 0u);
    uint key_x = key.z, key_y = key.w;
    float x, y;
    scrambled_radical_inverse(&sample, &key_x, 1u, 5u, 11u, 1.0f / 48828125.0f, &x);
    scrambled_radical_inverse(&sample, &key_y, 1u, 7u, 9u, 1.0f / 40353607.0f, &y);
    u.x = x;
    u.y = y;
  }
  if (SAMPLER == SAMPLER_SOBOL) {
    uint4 key = pcg4d(pixel, p->seed, STREAM_SOBOL, 0u);
    u = sobol23(sample, key.z, key.w);
  }
  if (SAMPLER == SAMPLER_ZORDER) {
    uint tile;
    uint index = zorder_index(pixel, sample, p->total_samples, p->width, p->seed, &tile);
    uint4 key = pcg4d(tile, p->seed, STREAM_ZORDER, 0u);
    u = sobol23(index, key.z, key.w);
  }
  // No early return: the loop over camera rays is to become one over vectors of them.
  const bool alone = p->total_samples == 1u;
  u.x = alone ? 0.5f : u.x;
  u.y = alone ? 0.5f : u.y;
  return u;
}

// The points that directions direction[k] of camera samples sample[k] of pixels pixel[k] are warped from, in [0,1)², from seeds
// seed[k]; `count` of them, at most 16. A CPU's compiler makes 8 or 16 at a time of a constant number of them.
INLINE void sample_directions(const uint* pixel, const uint* sample, const uint* direction, const uint* seed, uint count,
                              const EstimatorParams* p, __global const float* point_set, float* ux, float* uy) {
  const uint points = p->total_samples * p->total_directions;
  uint index[16];
  for (uint k = 0; k < count; ++k) index[k] = sample[k] * p->total_directions + direction[k];
  if (SAMPLER == SAMPLER_INDEPENDENT)
    for (uint k = 0; k < count; ++k) {
      uint4 h = pcg4d(pixel[k], sample[k], direction[k], SEED(k));
      ux[k] = uint_to_unit_float(h.x);
      uy[k] = uint_to_unit_float(h.y);
    }
  if (SAMPLER == SAMPLER_STRATIFIED) {
    uint key[16];
    for (uint k = 0; k < count; ++k) key[k] = pcg4d(pixel[k], SEED(k), STREAM_STRATIFIED, 1u).x;
    stratified_point(index, key, count, points, ux, uy);
  }
  if (SAMPLER == SAMPLER_HALTON) {
    uint key_x[16], key_y[16];
    for (uint k = 0; k < count; ++k) {
      uint4 key = pcg4d(pixel[k], SEED(k), STREAM_HALTON, 0u);
      key_x[k] = key.x;
      key_y[k] = key.y;
    }
    scrambled_radical_inverse(index, key_x, count, 2u, 24u, 0x1p-24f, ux);
    scrambled_radical_inverse(index, key_y, count, 3u, 16u, 1.0f / 43046721.0f, uy);
  }
  if (SAMPLER == SAMPLER_SOBOL)
    for (uint k = 0; k < count; ++k) {
      uint4 key = pcg4d(pixel[k], SEED(k), STREAM_SOBOL, 0u);
      float2 u = sobol01(index[k], key.x, key.y);
      ux[k] = u.x;
      uy[k] = u.y;
    }
  if (SAMPLER == SAMPLER_ZORDER)
    for (uint k = 0; k < count; ++k) {
      uint tile;
      uint shuffled = zorder_index(pixel[k], index[k], points, p->width, SEED(k), &tile);
      uint4 key = pcg4d(tile, SEED(k), STREAM_ZORDER, 0u);
      float2 u = sobol01(shuffled, key.x, key.y);
      ux[k] = u.x;
      uy[k] = u.y;
    }
  if (SAMPLER == SAMPLER_POINTS)
    for (uint k = 0; k < count; ++k) {
      ux[k] = point_set[2u * direction[k]];
      uy[k] = point_set[2u * direction[k] + 1u];
      if (POINTS_AS_THEY_ARE) continue;
      uint4 key = pcg4d(pixel[k], SEED(k), STREAM_POINTS, 0u);
      ux[k] = sum_modulo_1(ux[k], uint_to_unit_float(key.x));
      uy[k] = sum_modulo_1(uy[k], uint_to_unit_float(key.y));
    }
}

// One of them, from the seed that all have.
INLINE float2 sample_direction(uint pixel, uint sample, uint direction, const EstimatorParams* p) {
  float2 u;
  float x, y;
  sample_directions(&pixel, &sample, &direction, &p->seed, 1u, p, 0, &x, &y);
  u.x = x;
  u.y = y;
  return u;
}

#endif
