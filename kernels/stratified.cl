// Multi-jittered points for any number of them.
// Kensler 2013, "Correlated Multi-Jittered Sampling" (Pixar TM 13-01), section on arbitrary sample counts, with own
// permutations. n points fill `columns` x `rows` cells (the last row perhaps in part); in y each point also has one
// of n strips for itself, and in x one of `rows` sub-columns of its column.
// Unbiased for every n: point i sits in the cell of a uniform random rank s, s / n + jitter is uniform in y, and given s
// the column and sub-column are uniform, hence x is.
#ifndef NOOK_STRATIFIED_CL
#define NOOK_STRATIFIED_CL

#include "random.cl"

// Point i < n of the set that `key` chooses, in [0,1)².
float2 stratified_point(uint i, uint n, uint key) {
  uint columns = max(1u, (uint)(sqrt((float)n) + 0.5f));
  uint rows = (n - 1u) / columns + 1u;
  uint s = permute(i, n, key);
  uint row = s / columns;
  uint column = permute(s % columns, columns, pcg(key ^ 0x68bc21ebu) + row);
  uint sub_column = permute(row, rows, pcg(key ^ 0x02e5be93u) + column);
  uint4 jitter = pcg4d(i, n, key, 0x967a889bu);
  float2 u;
  u.x = (float)(column * rows + sub_column) + uint_to_unit_float(jitter.x);
  u.y = (float)s + uint_to_unit_float(jitter.y);
  u.x = fmin(u.x / ((float)columns * (float)rows), 0x1.fffffep-1f);
  u.y = fmin(u.y / (float)n, 0x1.fffffep-1f);
  return u;
}

#endif
