// The Halton sequence with nested (Owen) scrambling of its digits.
// Halton 1964; Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences".
// A digit d of base b becomes (a d + c) mod b, with (a, c) drawn anew for each prefix of preceding digits. These affine
// maps take each pair of different digits to each such pair equally often, so first and second moments (hence bias
// and variance) are those of uniform random permutations.
#ifndef NOOK_HALTON_CL
#define NOOK_HALTON_CL

#include "random.cl"

// Scrambled radical inverse of `index` in a prime base, in [0,1). `digits` fixes the resolution: base^digits must fit
// in 32 bits and should exceed 2^24; `scale` is base^-digits (a product is the same on every device, a quotient is not).
float scrambled_radical_inverse(uint index, uint base, uint digits, float scale, uint seed) {
  uint node = seed;  // identifies the digits so far
  uint numerator = 0;
  for (uint k = 0; k < digits; ++k) {
    uint digit = index % base;
    index /= base;
    uint factor_bits = pcg(node), offset_bits = pcg(factor_bits ^ 0x5bf03635u);
    uint factor = 1u + uint_below(factor_bits, base - 1u), offset = uint_below(offset_bits, base);
    numerator = numerator * base + (digit * factor + offset) % base;
    node = pcg(node + 0x9e3779b9u * (digit + 1u));
  }
  return fmin((float)numerator * scale, 0x1.fffffep-1f);
}

#endif
