// What one work-item does: some samples of one pixel (or of one row of a point list).
#ifndef NOOK_SHARED_TASK_H
#define NOOK_SHARED_TASK_H

#include "portable.h"

typedef struct {
  nook_uint pixel;            // y * width + x, or the row of a point list: the random numbers' key
  nook_uint first_sample;     // index of the first camera sample; with REPLICATE_DIRECTIONS, where there is one alone, the number
                              // of the randomisation whose seed the task has (seed_of_randomisation())
  nook_uint first_direction;  // index of the first direction of each camera sample
  nook_uint point;            // index of this task's first SurfacePoint; sample s of the task is at point + s
} Task;

// Points and directions of a pixel are numbered globally; a launch covers a range of them, so that tiles, shards,
// resumed and adaptive runs add up to the same integers.
typedef struct {
  nook_uint samples;           // camera samples in each task of this launch
  nook_uint directions;        // directions per camera sample in this launch
  nook_uint total_samples;     // camera samples a pixel gets in the whole render (stratification needs it)
  nook_uint total_directions;  // directions a camera sample gets in the whole render
  nook_uint seed;
  nook_uint width;             // of the whole image, pixels (Z-order samplers need it); 0 for point lists
  float max_distance;          // world units; INFINITY if unlimited
  float exponent;              // RO: Phong exponent
  float sum_scale;             // fixed point of TaskResult.sum, a power of two
  float square_scale;          // fixed point of TaskResult.sum_square
  float min_distance;          // world units; nearer surfaces do not occlude
  float cone_sine;             // of the half-angle of the cone about the normal that AO looks into
  float cone_cosine;
} EstimatorParams;

#endif
