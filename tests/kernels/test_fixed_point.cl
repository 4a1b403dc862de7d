// to_fixed_point() of given numbers.
#include "stage/fixed_point.cl"

__kernel void fixed_point_of(__global const float* x, __global ulong* out) {
  const uint i = get_global_id(0);
  out[i] = to_fixed_point(x[i]);
}
