// Reflection occlusion: how much of a uniform sky the Phong lobe about the mirror direction sees.
//   RO = (n+2)/(2 pi) ∫ max(0, r.w)^n max(0, N.w) V(w) dw,   r = 2 (N.v) N - v
// v is the direction to the viewer, N the shading normal, n the exponent. L_e = 1, and the lobe (n+2)/(2 pi) cos^n is
// normalised so that a mirror seen head-on has RO = 1 (Lafortune and Willems 1994, "Using the modified Phong reflectance
// model for physically based rendering"). Estimated by RO ≈ 1/k Σ weight V, weight = integrand / pdf, with
//   lobe        pdf = (n+1)/(2 pi) cos^n(r,w)    weight = (n+2)/(n+1) max(0, N.w), the powers cancelled
//   cosine      pdf = N.w/pi                     weight = (n+2)/2 cos^n(r,w)
//   hemisphere  pdf = 1/(2 pi)                   weight = (n+2) cos^n(r,w) N.w
//   sphere      pdf = 1/(4 pi)                   weight = 2 (n+2) cos^n(r,w) max(0, N.w)
//   mixture     pdf = c lobe + (1-c) cosine      one-sample multiple importance sampling with the balance heuristic
//                                                (Veach 1997, section 9.2.4)
// A direction under the horizon of N is not traced: its weight is 0.
#ifndef NOOK_REFLECTION_CL
#define NOOK_REFLECTION_CL

#include "config.h"
#include "sample/frame.cl"
#include "inline.h"
#include "sample/warp.cl"

float cosine_between(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// v mirrored about n.
float3 mirror_direction(float3 n, float3 v) {
  float twice = 2.0f * cosine_between(n, v);
  return (float3)(twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z);
}

// cos^n of the angle between unit vectors a and b; 0 from a right angle on, also for n = 0. With the chord d = |a - b|,
// cos = 1 - d²/2, whose logarithm is accurate where a.b rounds to 1.
float cosine_power(float3 a, float3 b, float n) {
  float3 chord = a - b;
  float half_square = 0.5f * dot(chord, chord);
  return half_square < 1.0f ? exp(n * log1p(-half_square)) : 0.0f;
}

// The share c of the lobe in the mixture. A fit to the shares of least variance for an open sky, which are 0, 0.5, 0.86,
// 0.95, 0.99 at exponents 0, 1, 2, 3, 5 and 60 degrees, and vary little with the angle. Any share in [0,1] is unbiased.
float lobe_share(float exponent) {
  float cube = exponent * exponent * exponent;
  return cube / (1.0f + cube);
}

// One direction (unit, world) from u in [0,1)²; normal and view are unit vectors, exponent in [0, 1e7]. Returns its weight;
// 0: do not trace.
INLINE float reflection_sample(float2 u, float3 normal, float3 view, float exponent, float3* direction) {
  float3 mirror = mirror_direction(normal, view);
  bool from_lobe = SAMPLING == SAMPLING_LOBE;
  float share = lobe_share(exponent);
  if (SAMPLING == SAMPLING_MIXTURE) {
    from_lobe = u.x < share;
    u.x = fmin(from_lobe ? u.x / share : (u.x - share) / (1.0f - share), ONE_MINUS_EPSILON);
  }
  float3 in_frame;
  if (from_lobe)
    in_frame = square_to_cosine_power(u, exponent);
  else if (SAMPLING == SAMPLING_HEMISPHERE)
    in_frame = square_to_hemisphere(u);
  else if (SAMPLING == SAMPLING_SPHERE)
    in_frame = square_to_sphere(u);
  else
    in_frame = square_to_cosine_hemisphere(u);
  Frame frame = frame_about((float3)(from_lobe ? mirror.x : normal.x, from_lobe ? mirror.y : normal.y, from_lobe ? mirror.z : normal.z));
  float3 w = to_world(&frame, in_frame);
  *direction = w;

  float cosine = cosine_between(normal, w);
  if (SAMPLING == SAMPLING_LOBE) return cosine > 0.0f ? (exponent + 2.0f) / (exponent + 1.0f) * cosine : 0.0f;
  if (!(cosine > 0.0f)) return 0.0f;
  float lobe = cosine_power(mirror, w, exponent);
  if (SAMPLING == SAMPLING_HEMISPHERE) return (exponent + 2.0f) * lobe * cosine;
  if (SAMPLING == SAMPLING_SPHERE) return 2.0f * (exponent + 2.0f) * lobe * cosine;
  if (SAMPLING == SAMPLING_COSINE) return 0.5f * (exponent + 2.0f) * lobe;
  return (exponent + 2.0f) * lobe * cosine / (share * (exponent + 1.0f) * lobe + 2.0f * (1.0f - share) * cosine);
}

#endif
