// Multi-jittered points for any number of them.
// Kensler 2013, "Correlated Multi-Jittered Sampling" (Pixar TM 13-01), section on arbitrary sample counts, with own
// permutations. n points fill `columns` x `rows` cells (the last row perhaps in part); in y each point also has one
// of n strips for itself, and in x one of `rows` sub-columns of its column.
// Unbiased for every n: point i sits in the cell of a uniform random rank s, s / n + jitter is uniform in y, and given s
// the column and sub-column are uniform, hence x is.
#ifndef NOOK_STRATIFIED_CL
#define NOOK_STRATIFIED_CL

#include "random.cl"

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

// Point i < n of the set that `key` chooses, in [0,1)².
float2 stratified_point(uint i, uint n, uint key) {
  uint columns = integer_root(n);
  uint rows = (n - 1u) / columns + 1u;
  uint s = permute(i, n, key);
  uint row = s / columns;
  uint column = permute(s % columns, columns, pcg(key ^ 0x68bc21ebu) + row);
  uint sub_column = permute(row, rows, pcg(key ^ 0x02e5be93u) + column);
  uint4 jitter = pcg4d(i, n, key, 0x967a889bu);
  float2 u;
  u.x = jittered(column * rows + sub_column, columns * rows, jitter.x);
  u.y = jittered(s, n, jitter.y);
  return u;
}

#endif
