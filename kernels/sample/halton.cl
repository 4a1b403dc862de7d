// The Halton sequence with nested (Owen) scrambling of its digits.
// Halton 1964; Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences".
// A digit d of base b becomes (a d + c) mod b, with (a, c) drawn anew for each prefix of preceding digits. These affine
// maps take each pair of different digits to each such pair equally often, so first and second moments (hence bias
// and variance) are those of uniform random permutations.
#ifndef NOOK_HALTON_CL
#define NOOK_HALTON_CL

#include "sample/random.cl"

// Scrambled radical inverses of `count` indices, at most 16, in a prime base, in [0,1). `digits` fixes the resolution: base^digits
// must fit in 32 bits and should exceed 2^24; `scale` is base^-digits (a product is the same on every device, a quotient is not).
INLINE void scrambled_radical_inverse(const uint* index, const uint* seed, uint count, uint base, uint digits, float scale, float* u) {
  uint node[16], rest[16], numerator[16];  // node: identifies the digits so far
  for (uint k = 0; k < count; ++k) node[k] = seed[k], rest[k] = index[k], numerator[k] = 0;
  for (uint place = 0; place < digits; ++place)
    for (uint k = 0; k < count; ++k) {
      const uint digit = rest[k] % base;
      rest[k] /= base;
      const uint factor_bits = pcg(node[k]), offset_bits = pcg(factor_bits ^ 0x5bf03635u);
      const uint factor = 1u + uint_below(factor_bits, base - 1u), offset = uint_below(offset_bits, base);
      numerator[k] = numerator[k] * base + (digit * factor + offset) % base;
      node[k] = pcg(node[k] + 0x9e3779b9u * (digit + 1u));
    }
  for (uint k = 0; k < count; ++k) u[k] = fmin((float)numerator[k] * scale, 0x1.fffffep-1f);
}

#endif
