// The sizes and offsets of the structs that host and kernels share, as this device has them: those of
// SHARED_LAYOUT in its order. out[0] is how many there are.
#include "shared/bvh.h"
#include "shared/camera.h"
#include "shared/surface_point.h"
#include "shared/task.h"
#include "shared/task_result.h"
#ifndef SHARED_LAYOUT  // flattened in front of this file by the test
#define SHARED_LAYOUT(STRUCT, FIELD)
#endif

typedef BvhNode NodeOfKernel;

__kernel void layout(__global uint* out) {
  if (get_global_id(0) != 0) return;
  uint n = 1;
#define SIZE(type) out[n++] = (uint)sizeof(type);
#define OFFSET(type, name)                                                      \
  {                                                                             \
    type value;                                                                 \
    out[n++] = (uint)((__private char*)&value.name - (__private char*)&value);  \
  }
  SHARED_LAYOUT(SIZE, OFFSET)
  out[0] = n - 1;
}
