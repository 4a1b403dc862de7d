// Ambient occlusion (Zhukov et al. 1998; Landis 2002), 1 where nothing is near:
//   AO = 1/pi ∫ V(w) max(0, N.w) dw
// V(w) = 1 if no surface lies within max_distance along w. Estimated by AO ≈ 1/n Σ weight_k V(w_k), with
//   cosine      pdf = N.w/pi    weight = 1               variance AO - AO²
//   hemisphere  pdf = 1/(2 pi)  weight = 2 N.w           in [0, 2]
//   sphere      pdf = 1/(4 pi)  weight = 4 max(0, N.w)   in [0, 4]
// or, with uniform weights, the open share of the hemisphere's solid angle (of the cone's, in cone.cl):
//   AO = 1/(2 pi) ∫ V(w) dw
//   hemisphere  pdf = 1/(2 pi)  weight = 1               variance AO - AO²
//   sphere      pdf = 1/(4 pi)  weight = 2 above         variance 2 AO - AO²
// (cosine-distributed directions would have 1/(2 N.w), without bound).
#ifndef NOOK_AMBIENT_CL
#define NOOK_AMBIENT_CL

#include "config.h"
#include "sample/frame.cl"
#include "inline.h"
#include "sample/warp.cl"

// The weight of a direction at cosine z to the normal, drawn uniformly from the cone about it of half-angle a (the
// hemisphere: cos a = 0): its part of the integral over its density.
INLINE float weight_of_uniform(float z, float cos_a) {
  return WEIGHT == WEIGHT_UNIFORM ? 1.0f : 2.0f * z / (1.0f + cos_a);
}

// One direction (unit, world) about the unit shading normal from u in [0,1)². Returns its weight; 0: do not trace.
INLINE float ambient_sample(float2 u, float3 normal, float3* direction) {
  Frame frame = frame_about(normal);
  float3 in_frame;
  float weight;
  if (SAMPLING == SAMPLING_HEMISPHERE) {
    in_frame = square_to_hemisphere(u);
    weight = weight_of_uniform(in_frame.z, 0.0f);
  } else if (SAMPLING == SAMPLING_SPHERE) {
    in_frame = square_to_sphere(u);
    weight = WEIGHT == WEIGHT_UNIFORM ? (in_frame.z > 0.0f ? 2.0f : 0.0f) : 4.0f * fmax(0.0f, in_frame.z);
  } else {
    in_frame = square_to_cosine_hemisphere(u);
    weight = 1.0f;
  }
  *direction = to_world(&frame, in_frame);
  return weight;
}

#endif
