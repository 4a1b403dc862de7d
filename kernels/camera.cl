// Camera rays. For pixel (x, y), row 0 at the top, and a position (dx, dy) in the pixel:
//   px = (2 (x + dx) / W - 1) tan(fov_x/2)      py = (1 - 2 (y + dy) / H) tan(fov_y/2)
//   direction = normalise(px right + py up + forward)
#ifndef NOOK_CAMERA_CL
#define NOOK_CAMERA_CL

#include "shared/camera.h"

// Unit direction of the ray through `position` (in [0,1)²) of pixel (x, y).
float3 camera_direction(const CameraParams* camera, uint x, uint y, float2 position) {
  float px = (2.0f * ((float)x + position.x) / (float)camera->width - 1.0f) * camera->tan_half_fov_x;
  float py = (1.0f - 2.0f * ((float)y + position.y) / (float)camera->height) * camera->tan_half_fov_y;
  float3 right = (float3)(camera->right[0], camera->right[1], camera->right[2]);
  float3 up = (float3)(camera->up[0], camera->up[1], camera->up[2]);
  float3 forward = (float3)(camera->forward[0], camera->forward[1], camera->forward[2]);
  return normalize(px * right + py * up + forward);
}

#endif
