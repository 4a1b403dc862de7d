// Multi-jittered points for any number of them.
// Kensler 2013, "Correlated Multi-Jittered Sampling" (Pixar TM 13-01), section on arbitrary sample counts, with own
// permutations. n points fill `columns` x `rows` cells (the last row perhaps in part); in y each point also has one
// of n strips for itself, and in x one of `rows` sub-columns of its column.
// Unbiased for every n: point i sits in the cell of a uniform random rank s, s / n + jitter is uniform in y, and given s
// the column and sub-column are uniform, hence x is.
#ifndef NOOK_STRATIFIED_CL
#define NOOK_STRATIFIED_CL

#include "sample/random.cl"

// The largest integer whose square is at most n.
uint integer_root(uint n) {
  uint root = 0;
  for (uint bit = 1u << 15; bit > 0u; bit >>= 1)
    if ((root | bit) * (root | bit) <= n) root |= bit;
  return root;
}

// (cell + jitter) / cells in [0,1), jitter the 24 high bits; in integers, so that it is exact and never rounds up to 1.
float jittered(uint cell, uint cells, uint bits) {
  ulong position = ((ulong)cell << 24) + (bits >> 8);
  return (float)(uint)(position / cells) * 0x1p-24f;
}

// Points i[k] < n of the sets that key[k] chooses, in [0,1)²; `count` of them, at most 16.
INLINE void stratified_point(const uint* i, const uint* key, uint count, uint n, float* ux, float* uy) {
  const uint columns = integer_root(n);
  const uint rows = (n - 1u) / columns + 1u;
  uint s[16], row[16], column[16], sub_column[16], column_key[16], sub_column_key[16];
  for (uint k = 0; k < count; ++k) s[k] = i[k];
  permute(s, key, count, n);
  for (uint k = 0; k < count; ++k) row[k] = sub_column[k] = s[k] / columns, column[k] = s[k] % columns;
  for (uint k = 0; k < count; ++k) column_key[k] = pcg(key[k] ^ 0x68bc21ebu) + row[k];
  permute(column, column_key, count, columns);
  for (uint k = 0; k < count; ++k) sub_column_key[k] = pcg(key[k] ^ 0x02e5be93u) + column[k];
  permute(sub_column, sub_column_key, count, rows);
  for (uint k = 0; k < count; ++k) {
    const uint4 jitter = pcg4d(i[k], n, key[k], 0x967a889bu);
    ux[k] = jittered(column[k] * rows + sub_column[k], columns * rows, jitter.x);
    uy[k] = jittered(s[k], n, jitter.y);
  }
}

#endif
