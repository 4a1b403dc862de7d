// What one Task adds to its pixel: integers, so that sums are the same in any order.
#ifndef NOOK_SHARED_TASK_RESULT_H
#define NOOK_SHARED_TASK_RESULT_H

#include "portable.h"

typedef struct {
  nook_ulong sum;         // Σ w V, times sum_scale
  nook_ulong sum_square;  // Σ (replicate)², times square_scale; a replicate is a direction or the mean over a camera ray's
  nook_uint hits;         // camera rays that hit the mesh
  nook_uint rays;         // occlusion rays traced
  nook_uint rejected;     // estimates that were not finite, left out of the sums
  nook_uint free;         // camera rays at whose points nothing was in reach; 0 where that is not asked (REACH)
} TaskResult;

#endif
