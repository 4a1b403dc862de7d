// Four dimensions of the Sobol' sequence with Owen scrambling.
// Burley 2020, "Practical Hash-based Owen Scrambling" (JCGT 9(4)); hash constants from Vegdahl 2021, "Building a Better
// LK Hash". Everything stays in the bit-reversed domain, where nested scrambling is a hash in which a bit depends on
// lower bits only; one reversal at the end yields the fraction.
#ifndef NOOK_SOBOL_CL
#define NOOK_SOBOL_CL

#include "inline.h"
#include "sample/random.cl"

// Nested uniform scramble of a bit-reversed fraction; `seed` must itself be well mixed.
INLINE uint owen_scramble_reversed(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Dimension 0 is the van der Corput sequence: the reversed fraction is the index itself.
INLINE uint sobol0_reversed(uint index) { return index; }

// Dimension 1 has the binary Pascal matrix: with the index's bits as the coefficients of a polynomial a over GF(2), the
// reversed fraction is a(x + 1), and a = lo + x^h hi gives a(x+1) = (lo + hi)(x+1) + x^h hi(x+1) for h a power of two.
INLINE uint sobol1_reversed(uint index) {
  index ^= (index & 0xffff0000u) >> 16;
  index ^= (index & 0xff00ff00u) >> 8;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xccccccccu) >> 2;
  return index ^ ((index & 0xaaaaaaaau) >> 1);
}

// Dimensions 2 and 3: bit-reversed direction numbers of Joe and Kuo 2008 (new-joe-kuo-6.21201, d = 3 and 4: polynomials
// x^2+x+1 and x^3+x+1, m = 1,3 and 1,3,1).
__constant uint sobol2_directions[32] = {
    0x00000001u, 0x00000003u, 0x00000006u, 0x00000009u, 0x00000017u, 0x0000003au, 0x00000071u, 0x000000a3u,
    0x00000116u, 0x00000339u, 0x00000677u, 0x000009aau, 0x00001601u, 0x00003903u, 0x00007706u, 0x0000aa09u,
    0x00010117u, 0x0003033au, 0x00060671u, 0x000909a3u, 0x00171616u, 0x003a3939u, 0x00717777u, 0x00a3aaaau,
    0x01170001u, 0x033a0003u, 0x06710006u, 0x09a30009u, 0x16160017u, 0x3939003au, 0x77770071u, 0xaaaa00a3u};
__constant uint sobol3_directions[32] = {
    0x00000001u, 0x00000003u, 0x00000004u, 0x0000000au, 0x0000001fu, 0x0000002eu, 0x00000045u, 0x000000c9u,
    0x0000011bu, 0x000002a4u, 0x0000079au, 0x00000b67u, 0x0000101eu, 0x0000302du, 0x00004041u, 0x0000a0c3u,
    0x0001f104u, 0x0002e28au, 0x000457dfu, 0x000c9baeu, 0x0011a105u, 0x002a7289u, 0x0079e7dbu, 0x00b6dba4u,
    0x0100011au, 0x030002a7u, 0x0400079eu, 0x0a000b6du, 0x1f001001u, 0x2e003003u, 0x45004004u, 0xc900a00au};

// Sums over GF(2) of the direction numbers of the index's bits: of all 32, so that no branch hangs on the index, and a loop over points
// becomes one over vectors of points.
INLINE uint sobol2_reversed(uint index) {
  uint x = 0;
  UNROLL for (uint bit = 0; bit < 32u; ++bit) x ^= (0u - (index >> bit & 1u)) & sobol2_directions[bit];
  return x;
}

INLINE uint sobol3_reversed(uint index) {
  uint x = 0;
  UNROLL for (uint bit = 0; bit < 32u; ++bit) x ^= (0u - (index >> bit & 1u)) & sobol3_directions[bit];
  return x;
}

// Point `index` in dimensions 0 and 1 (a (0,2)-sequence), in [0,1)².
INLINE float2 sobol01(uint index, uint seed0, uint seed1) {
  float2 u;
  u.x = uint_to_unit_float(reverse_bits(owen_scramble_reversed(sobol0_reversed(index), seed0)));
  u.y = uint_to_unit_float(reverse_bits(owen_scramble_reversed(sobol1_reversed(index), seed1)));
  return u;
}

// Point `index` in dimensions 2 and 3, in [0,1)².
INLINE float2 sobol23(uint index, uint seed2, uint seed3) {
  float2 u;
  u.x = uint_to_unit_float(reverse_bits(owen_scramble_reversed(sobol2_reversed(index), seed2)));
  u.y = uint_to_unit_float(reverse_bits(owen_scramble_reversed(sobol3_reversed(index), seed3)));
  return u;
}

#endif
