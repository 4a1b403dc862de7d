// The assignment's point estimator of ambient occlusion, with directions w_i uniform on the hemisphere about the normal:
//   AO(x) = 1/pi int V(x, w) cos(theta) dw  ~  1/N sum_i V(y_i) cos(theta_i) / (pi pdf),   pdf = 1/(2 pi),
// where y_i = x + RADIUS w_i and V(y) = 1 if the surface seen through the pixel of y is farther than y.
// A flat surface seen head on gives exactly 1: the elevations cos(theta_i) = (i + 1/2)/N are fixed, the azimuth is
// turned by a random angle in each pixel. With COSINE the directions are cosine-weighted instead, pdf = cos(theta)/pi.
// AS_PUBLISHED draws them independently and clamps the sum to 1, as an 8-bit frame buffer does: a flat surface is then 1 -
// sqrt(1/(3N) / (2 pi)) = 0.959 on average for N = 32, and the published means come out.
// Rules: background pixels are 0 with coverage 0; y behind the eye (depth <= 0) or outside the buffer is visible.
in vec2 uv;
layout(location = 0) out vec4 result;

uniform sampler2D positions;      // view space, w = coverage
uniform sampler2D exact_normals;  // view space, unit
uniform ivec2 shaded_size;    // pixels of the image that is shaded
uniform float radius;         // world units
uniform float bias;           // world units

bool visible(vec3 x, vec3 y) {
  vec3 h = homogeneous(y);
  if (!(h.z > 0.0)) return true;
  ivec2 texel = ivec2(floor(h.xy / h.z));
  if (!inside(texel)) return true;
  float depth = -texelFetch(positions, texel, 0).z;
  if (depth >= h.z - bias) return true;
  // A surface farther than the radius in front of x cannot occlude it: without this test silhouettes have dark halos.
  if (RANGE_CHECK != 0 && -x.z - depth > radius) return true;
  return false;
}

void main() {
  ivec2 pixel = ivec2(uv * vec2(shaded_size));
  ivec2 texel = pixel * STRIDE + guard;
  vec4 x = texelFetch(positions, texel, 0);
  if (x.w == 0.0) {
    result = vec4(0.0);
    return;
  }
  mat3 to_view = frame(texelFetch(exact_normals, texel, 0).xyz);
  uint seed = pcg(uint(pixel.y * (buffer_size.x - 2 * guard) + pixel.x));
  float turn = DENOISED != 0 ? block_noise(pixel).x : unit_float(seed);
  float sum = 0.0;
  for (int i = 0; i < SAMPLES; ++i) {
    float u = (float(i) + 0.5) / float(SAMPLES);
    if (AS_PUBLISHED != 0) {
      seed = pcg(seed);
      u = unit_float(seed);
      seed = pcg(seed);
      turn = unit_float(seed);
    }
    float z = COSINE != 0 ? sqrt(u) : u;
    float s = sqrt(1.0 - z * z);
    // Golden-angle spiral: well spread azimuths for every N.
    float phi = 2.0 * PI * fract(turn + 0.6180339887 * float(i));
    vec3 direction = to_view * vec3(s * cos(phi), s * sin(phi), z);
    float pdf = COSINE != 0 ? z / PI : 1.0 / (2.0 * PI);
    if (visible(x.xyz, x.xyz + radius * direction)) sum += z / (PI * pdf);
  }
  float value = sum / float(SAMPLES);
  result = vec4(AS_PUBLISHED != 0 ? min(value, 1.0) : value, -1.0 / x.z, 0.0, 0.0);
}
