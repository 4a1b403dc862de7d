// What the screen-space passes share: the camera's mapping (host/ssao/view.hpp) and per-pixel noise.
uniform vec2 ray_scale, ray_offset;
uniform ivec2 buffer_size;  // pixels, with the guard band
uniform int guard;          // pixels

uniform sampler2D surface;  // inverse depth, its gradient per pixel, inverse depth of the back layer; 0: nothing there
uniform sampler2D normals;  // view space, octahedral (glsl/gbuffer.frag)

const float PI = 3.14159265358979;

// The view-space point at buffer coordinates q and inverse depth.
vec3 reconstruct(vec2 q, float inverse_depth) { return vec3(q * ray_scale + ray_offset, -1.0) / inverse_depth; }

// The homogeneous buffer position of a view-space vector: (x, y) / z are buffer coordinates, z is depth.
vec3 homogeneous(vec3 view) { return vec3((view.xy + ray_offset * view.z) / ray_scale, -view.z); }

bool inside(ivec2 texel) { return all(lessThan(uvec2(texel), uvec2(buffer_size))); }

// Duff et al. 2017, "Building an orthonormal basis, revisited".
mat3 frame(vec3 n) {
  float s = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

vec3 normal_at(ivec2 texel) {
  vec2 p = texelFetch(normals, texel, 0).xy * (65535.0 / 32767.0) - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.xy -= vec2(n.x < 0.0 ? -fold : fold, n.y < 0.0 ? -fold : fold);
  return normalize(n);
}

// PCG hash (Jarzynski and Olano 2020, "Hash functions for GPU rendering").
uint pcg(uint v) {
  uint state = v * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
float unit_float(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

// Two values in [0,1) for a pixel that are stratified over each 4x4 block of pixels, the window of the denoiser:
// the ranks of a Bayer matrix, and the same turned.
vec2 block_noise(ivec2 pixel) {
  ivec2 p = pixel & 3;
  int x = p.x ^ p.y;
  int rank = ((x & 1) << 3) | ((p.y & 1) << 2) | (x & 2) | (p.y >> 1);
  ivec2 r = ivec2(p.y, 3 - p.x);
  int y = r.x ^ r.y;
  int turned = ((y & 1) << 3) | ((r.y & 1) << 2) | (y & 2) | (r.y >> 1);
  return (vec2(rank, turned) + 0.5) / 16.0;
}
