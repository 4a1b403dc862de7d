// Counter-based random numbers: pure functions of integers, the same bits on every device and on the host.
#ifndef NOOK_RANDOM_CL
#define NOOK_RANDOM_CL

#include "inline.h"

// Hash of four integers to four. Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (JCGT 9(3)), pcg4d.
INLINE uint4 pcg4d(uint x, uint y, uint z, uint w) {
  uint4 v;
  v.x = x * 1664525u + 1013904223u;
  v.y = y * 1664525u + 1013904223u;
  v.z = z * 1664525u + 1013904223u;
  v.w = w * 1664525u + 1013904223u;
  for (uint round = 0; round < 2u; ++round) {
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    if (round == 1u) break;
    v.x ^= v.x >> 16;
    v.y ^= v.y >> 16;
    v.z ^= v.z >> 16;
    v.w ^= v.w >> 16;
  }
  return v;
}

// Hash of one integer. O'Neill 2014 (PCG RXS-M-XS), in the form of Jarzynski and Olano 2020.
INLINE uint pcg(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

// Uniform in {0, 2^-24, ..., 1 - 2^-24}. A plain scale by 2^-32 would round up to 1 now and then.
INLINE float uint_to_unit_float(uint bits) { return (float)(bits >> 8) * 0x1p-24f; }

// Uniform integer in [0, n) from 32 random bits: the high word of bits * n. Off by less than n 2^-32 (relative).
INLINE uint uint_below(uint bits, uint n) { return (uint)(((ulong)bits * n) >> 32); }

// The seed of randomisation `number`, from 1, of `seed`; of 0, the seed itself. Steele, Lea and Flood 2014, splitmix64, as
// Randomisations::seed_of() in host/trace has it.
INLINE uint seed_of_randomisation(uint seed, uint number) {
  if (number == 0u) return seed;
  ulong x = ((ulong)seed << 32 | (number - 1u)) + 0x9e3779b97f4a7c15ul;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ul;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebul;
  return (uint)((x ^ (x >> 31)) >> 32);
}

INLINE uint reverse_bits(uint x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
  x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
  return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

// A random permutation of [0, n) applied to each of `count` elements i[k] < n, at most 16; key[k] chooses it. Each image is exactly
// uniform over keys, whatever the rounds do, thanks to the closing rotation.
// A round is a bijection of k bits (odd multiple, offset, xor-shift); values >= n walk on along their cycle. Twelve rounds:
// with 8, the images of two elements of 5 still show a dependence of 0.5 %, with 12 none in 200000 keys.
INLINE void permute(uint* i, const uint* key, uint count, uint n) {
  const uint bits = n > 1u ? 32u - clz(n - 1u) : 1u;
  const uint mask = 0xffffffffu >> (32u - bits), shift = (bits + 1u) / 2u;
  uint first[16], h[16], moved[16];
  for (uint k = 0; k < count; ++k) first[k] = pcg(key[k] ^ 0x7065726du), moved[k] = i[k];
  uint beyond = n;  // the largest that was met in the last step
  for (uint step = 0; beyond >= n; ++step) {
    for (uint k = 0; k < count; ++k) h[k] = first[k], i[k] = moved[k];
    for (uint round = 0; round < 12u; ++round)
      for (uint k = 0; k < count; ++k) {
        h[k] = pcg(h[k]);
        uint x = (moved[k] * (h[k] >> 16 | 1u) + h[k]) & mask;
        moved[k] = x ^ x >> shift;
      }
    beyond = 0;
    for (uint k = 0; k < count; ++k) {
      moved[k] = step > 0u && i[k] < n ? i[k] : moved[k];
      beyond = moved[k] > beyond ? moved[k] : beyond;
    }
  }
  for (uint k = 0; k < count; ++k) {
    const ulong rotated = (ulong)moved[k] + uint_below(pcg(first[k] + 1u), n);
    i[k] = (uint)(rotated >= n ? rotated - n : rotated);
  }
}

#endif
