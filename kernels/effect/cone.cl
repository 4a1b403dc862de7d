// Ambient occlusion within a cone of half-angle a about the normal, 1 where the cone is open:
//   AO = 1/(pi sin² a) ∫_cone V(w) N.w dw
//   cosine      pdf = N.w/(pi sin² a)        weight = 1: the disk under the hemisphere, shrunk to radius sin a
//   hemisphere  pdf = 1/(2 pi (1 - cos a))   weight = 2 N.w / (1 + cos a), in [0, 2]
// With WEIGHT_UNIFORM, AO = 1/(2 pi (1 - cos a)) ∫_cone V(w) dw: hemisphere alone, weight = 1.
#ifndef NOOK_CONE_CL
#define NOOK_CONE_CL

#include "ambient.cl"
#include "config.h"
#include "sample/frame.cl"
#include "inline.h"
#include "sample/warp.cl"

// One direction (unit, world) of the cone from u in [0,1)². Returns its weight.
INLINE float ambient_cone_sample(float2 u, float3 normal, float sine, float cosine, float3* direction) {
  Frame frame = frame_about(normal);
  float3 in_frame;
  float weight;
  if (SAMPLING == SAMPLING_HEMISPHERE) {
    in_frame = square_to_hemisphere(u);
    const float depth = (1.0f - in_frame.z) * (1.0f - cosine);
    const float radius = sqrt(depth * (2.0f - depth));
    const float radius_before = sqrt(in_frame.x * in_frame.x + in_frame.y * in_frame.y);
    const float scale = radius_before > 0.0f ? radius / radius_before : 0.0f;
    in_frame = (float3)(scale * in_frame.x, scale * in_frame.y, 1.0f - depth);
    weight = weight_of_uniform(in_frame.z, cosine);
  } else {
    in_frame = square_to_cosine_hemisphere(u);
    const float x = sine * in_frame.x, y = sine * in_frame.y;
    in_frame = (float3)(x, y, sqrt(fmax(0.0f, 1.0f - (x * x + y * y))));
    weight = 1.0f;
  }
  *direction = to_world(&frame, in_frame);
  return weight;
}

#endif
