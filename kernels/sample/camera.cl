// Camera rays. For pixel (x, y), row 0 at the top, and a position (dx, dy) in the pixel:
//   px = (2 (x + dx) / W - 1) tan(fov_x/2)      py = (1 - 2 (y + dy) / H) tan(fov_y/2)
//   direction = normalise(px right + py up + forward)
#ifndef NOOK_CAMERA_CL
#define NOOK_CAMERA_CL

#include "inline.h"
#include "trace/rays.cl"
#include "sample/sampler.cl"
#include "shared/camera.h"

// One ray at a time or 16, the compiler rounds alike.
#pragma OPENCL FP_CONTRACT OFF

// Unit direction of the ray through `position` (in [0,1)²) of pixel (x, y).
INLINE void camera_direction(const CameraParams* camera, uint x, uint y, float2 position, Vector* direction) {
  const float px = (2.0f * ((float)x + position.x) / (float)camera->width - 1.0f) * camera->tan_half_fov_x;
  const float py = (1.0f - 2.0f * ((float)y + position.y) / (float)camera->height) * camera->tan_half_fov_y;
  const Vector d = {px * camera->right[0] + py * camera->up[0] + camera->forward[0],
                    px * camera->right[1] + py * camera->up[1] + camera->forward[1],
                    px * camera->right[2] + py * camera->up[2] + camera->forward[2]};
  const float inverse = 1.0f / sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  direction->x = d.x * inverse, direction->y = d.y * inverse, direction->z = d.z * inverse;
}

// Of camera samples sample[k] of pixels pixel[k], the first `count`. The entries behind them are read too, and mean nothing.
INLINE void camera_directions(const CameraParams* camera, const uint* pixel, const uint* sample, uint count, const EstimatorParams* p,
                              RayDirections* directions) {
  for (uint first = 0; first < count; first += RAYS_TOGETHER)
    for (uint k = first; k < first + RAYS_TOGETHER; ++k) {
      const float2 position = sample_pixel(pixel[k], sample[k], p);
      Vector d;
      camera_direction(camera, pixel[k] % camera->width, pixel[k] / camera->width, position, &d);
      directions->x[k] = d.x, directions->y[k] = d.y, directions->z[k] = d.z;
    }
}

#endif
