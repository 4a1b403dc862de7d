// Maps from the unit square to directions about +z, each with its inverse and its density.
//
// All start from the concentric disk map (Shirley and Chiu 1997), which sends (r, phi) on concentric squares to
// circles, and lift the disk's radius to a polar angle so that area goes to the wanted measure:
//   P(angle from z < theta) = r²   =>   theta(r)
// Written so that no form cancels: 1 - r² as (1-r)(1+r), sin(theta) never as sqrt(1 - cos²(theta)).
// Domain of u: [0,1)². With u a multiple of 2^-24 the coordinates 2u - 1 + 2^-24 are exact, symmetric about 0 and
// neither 0 nor +-1, so that no sampled direction is the pole or lies in the horizon.
#ifndef NOOK_WARP_CL
#define NOOK_WARP_CL

// The same bits wherever it is included, and for one direction or 16.
#pragma OPENCL FP_CONTRACT OFF

#define INV_PI 0.31830988618379067f
#define FOUR_OVER_PI 1.2732395447351628f
#define ONE_MINUS_EPSILON 0x1.fffffep-1f

// cos and sin of (pi/4) q for q in [-1, 1], to 1 ulp: Chebyshev fits of relative error below 4e-9.
float2 cos_sin_octant(float q) {
  float t = q * q;
  float c = fma(fma(fma(fma(3.529804506e-06f, t, -3.259386006e-04f), t, 1.585432524e-02f), t, -3.084251352e-01f), t, 1.0f);
  float s = fma(fma(fma(-3.595439920e-05f, t, 2.490006964e-03f), t, -8.074543477e-02f), t, 7.853981610e-01f) * q;
  return (float2)(c, s);
}

// The concentric map in polar form: returns r in [0,1], and (cos phi, sin phi).
float square_to_polar(float2 u, float2* azimuth) {
  float a = fma(2.0f, u.x, -1.0f) + 0x1p-24f;
  float b = fma(2.0f, u.y, -1.0f) + 0x1p-24f;
  bool a_leads = fabs(a) > fabs(b);
  float major = a_leads ? a : b, minor = a_leads ? b : a;
  float2 cs = cos_sin_octant(major == 0.0f ? 0.0f : minor / major);
  float sign = copysign(1.0f, major);
  *azimuth = (float2)(sign * (a_leads ? cs.x : cs.y), sign * (a_leads ? cs.y : cs.x));
  return fabs(major);
}

// The inverse of square_to_polar for radius r and any (x, y) of that azimuth; in [0,1)².
float2 polar_to_square(float r, float x, float y) {
  bool x_leads = fabs(x) > fabs(y);
  float major = x_leads ? x : y, minor = x_leads ? y : x;
  float signed_r = copysign(r, major);
  float other = major == 0.0f ? 0.0f : signed_r * FOUR_OVER_PI * atan(minor / major);
  float2 ab = x_leads ? (float2)(signed_r, other) : (float2)(other, signed_r);
  return clamp(fma(0.5f, ab, (float2)(0.5f)), (float2)(0.0f), (float2)(ONE_MINUS_EPSILON));
}

// Uniform unit disk.
float2 square_to_disk(float2 u) {
  float2 azimuth;
  float r = square_to_polar(u, &azimuth);
  return r * azimuth;
}

float2 disk_to_square(float2 p) { return polar_to_square(sqrt(dot(p, p)), p.x, p.y); }

// With respect to area on the disk.
float square_to_disk_pdf(float2 p) { return dot(p, p) <= 1.0f ? INV_PI : 0.0f; }

// Uniform sphere: r² = (1 - cos theta) / 2.
float3 square_to_sphere(float2 u) {
  float2 azimuth;
  float r = square_to_polar(u, &azimuth);
  float s = 2.0f * r * sqrt((1.0f - r) * (1.0f + r));
  return (float3)(s * azimuth.x, s * azimuth.y, fma(-2.0f * r, r, 1.0f));
}

float2 sphere_to_square(float3 w) {
  float r2 = w.z > 0.0f ? (w.x * w.x + w.y * w.y) / (2.0f * (1.0f + w.z)) : 0.5f * (1.0f - w.z);
  return polar_to_square(sqrt(r2), w.x, w.y);
}

// With respect to solid angle, 1/sr.
float square_to_sphere_pdf(void) { return 0.25f * INV_PI; }

// Uniform hemisphere z > 0: r² = 1 - cos theta.
float3 square_to_hemisphere(float2 u) {
  float2 azimuth;
  float r = square_to_polar(u, &azimuth);
  float z = (1.0f - r) * (1.0f + r);
  float s = r * sqrt(1.0f + z);
  return (float3)(s * azimuth.x, s * azimuth.y, z);
}

float2 hemisphere_to_square(float3 w) {
  return polar_to_square(sqrt((w.x * w.x + w.y * w.y) / (1.0f + w.z)), w.x, w.y);
}

// With respect to solid angle, 1/sr.
float square_to_hemisphere_pdf(float3 w) { return w.z > 0.0f ? 0.5f * INV_PI : 0.0f; }

// Cosine-weighted hemisphere: r = sin theta, the disk lifted straight up (Nusselt 1928; Malley 1988).
float3 square_to_cosine_hemisphere(float2 u) {
  float2 azimuth;
  float r = square_to_polar(u, &azimuth);
  return (float3)(r * azimuth.x, r * azimuth.y, sqrt((1.0f - r) * (1.0f + r)));
}

float2 cosine_hemisphere_to_square(float3 w) { return polar_to_square(sqrt(w.x * w.x + w.y * w.y), w.x, w.y); }

// With respect to solid angle, 1/sr.
float square_to_cosine_hemisphere_pdf(float3 w) { return w.z > 0.0f ? w.z * INV_PI : 0.0f; }

// log(cos theta) for w.z > 0, accurate near the pole too, where cos theta rounds to 1.
float log_cosine(float3 w) {
  float s2 = w.x * w.x + w.y * w.y;
  return s2 < 0.5f ? 0.5f * log1p(-s2) : log(w.z);
}

// log(1 - r²) for r in [0, 1 - 2^-24]: 1 - r² = 2^k (1 + f), f in [sqrt(1/2) - 1, sqrt(2) - 1]. Chebyshev fit of relative error 4e-9; log 2
// in two parts, the first of which is exact times k. Relative error below 3e-7.
float log_one_minus_square(float r) {
  uint bits = as_uint((1.0f - r) * (1.0f + r)) - 0x3f3504f3u;  // of sqrt(1/2)
  float k = (float)(as_int(bits) >> 23);
  float f = k == 0.0f ? -(r * r) : as_float((bits & 0x007fffffu) + 0x3f3504f3u) - 1.0f;
  float q = fma(fma(fma(fma(7.149753891e-02f, f, -1.157120073e-01f), f, 1.166151107e-01f), f, -1.241105068e-01f), f, 1.424993653e-01f);
  q = fma(fma(fma(fma(q, f, -1.666848024e-01f), f, 2.000070748e-01f), f, -2.499998905e-01f), f, 3.333333119e-01f);
  float square = f * f;
  float small = fma(square * f, q, fma(-0.5f, square, k * 1.42860682e-06f));
  return fma(k, 0.693145752f, f + small);
}

// e^x for x in [-80, 0] in two forms, each to its own relative accuracy: e^x and 1 - e^x. x = k log 2 + t, |t| <= log(2)/2; Chebyshev fit
// of e^t - 1 of relative error 6e-10.
float exp_and_rest(float x, float* rest) {
  float k = rint(x * 1.44269504f);
  float t = fma(k, -1.42860682e-06f, fma(k, -0.693145752f, x));
  float q = fma(fma(fma(fma(fma(1.989928785e-04f, t, 1.393365249e-03f), t, 8.333298466e-03f), t, 4.166646490e-02f), t, 1.666666672e-01f), t,
                5.000000013e-01f);
  float less = fma(t * t, q, t);
  float scale = as_float((uint)((int)k + 127) << 23);  // 2^k
  *rest = fma(-scale, less, 1.0f - scale);
  return fma(scale, less, scale);
}

// Cosine-power (Phong) lobe, density (n+1)/(2 pi) cos^n(theta), n >= 0: 1 - r² = cos^(n+1)(theta).
// sin² = (1 - cos)(1 + cos), 1 - cos as accurate as cos itself. Of what devices round differently only sqrt and the divisions are left.
float3 square_to_cosine_power(float2 u, float exponent) {
  float2 azimuth;
  float r = square_to_polar(u, &azimuth);
  float one_minus_cosine;
  float cosine = exp_and_rest(log_one_minus_square(r) / (exponent + 1.0f), &one_minus_cosine);
  float sine = sqrt(one_minus_cosine * (1.0f + cosine));
  return (float3)(sine * azimuth.x, sine * azimuth.y, cosine);
}

float2 cosine_power_to_square(float3 w, float exponent) {
  return polar_to_square(sqrt(-expm1((exponent + 1.0f) * log_cosine(w))), w.x, w.y);
}

// With respect to solid angle, 1/sr.
float square_to_cosine_power_pdf(float3 w, float exponent) {
  return w.z > 0.0f ? 0.5f * INV_PI * (exponent + 1.0f) * exp(exponent * log_cosine(w)) : 0.0f;
}

#endif
