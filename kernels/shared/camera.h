// Pinhole camera as the kernels use it; TinyRender's conventions (row 0 at the top).
#ifndef NOOK_SHARED_CAMERA_H
#define NOOK_SHARED_CAMERA_H

#include "portable.h"

typedef struct {
  float eye[3];
  nook_uint width;       // pixels
  float right[3];        // unit
  nook_uint height;
  float up[3];           // unit
  float tan_half_fov_x;  // aspect * tan(fov/2)
  float forward[3];      // unit
  float tan_half_fov_y;
} CameraParams;

#endif
