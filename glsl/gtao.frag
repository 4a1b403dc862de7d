// Ambient occlusion by slices: the hemisphere is cut by planes through the direction v to the eye. In the slice along
// d, with theta measured from v and gamma the angle of the normal projected into the slice (Jimenez et al. 2016,
// "Practical real-time strategies for accurate indirect occlusion"):
//   AO(x) = 1/pi int_0^pi dphi int |n_p| V(theta) max(0, cos(theta - gamma)) |sin theta| dtheta.
// Each side of a slice is a bit mask of 32 sectors (Therrien et al. 2023, "Screen space indirect lighting with visibility
// bitmask"); ours are equal in the weight above, not in angle. A tap looks through one pixel: the solid between its
// front and back layer is a piece of that pixel's view ray; what lies of it within the radius of x occludes the
// sectors between its two ends. Without a back layer the solid has no end.
// Rules: background pixels are 0 with coverage 0; taps outside the buffer occlude nothing.
layout(location = 0) out vec4 result;  // AO, inverse depth

uniform float radius;  // world units
#if LAYERS > 2
uniform sampler2D surface2;  // where the second and third solid begin and end
#endif

// |error| < 7e-5 (Abramowitz and Stegun 4.4.45).
float arc_cosine(float x) {
  float a = abs(x);
  float r = sqrt(1.0 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - 0.0187293 * a)));
  return x < 0.0 ? PI - r : r;
}

struct Side {
  float cos_gamma, sin_gamma;  // gamma measured towards this side
  float inverse_weight;        // 1 / integral over the side
};

// The integral over the side from v to its horizon gamma + pi/2, without |n_p|.
float side_weight(float cos_gamma, float sin_gamma, float gamma) {
  return 0.5 * (cos_gamma + (0.5 * PI + gamma) * sin_gamma);
}

// The share of the side's weight between v and the direction of p = (along d, along v).
float share(Side side, vec2 p) {
  vec2 n = p * inversesqrt(max(dot(p, p), 1e-30));
  float s = n.x, c = clamp(n.y, -1.0, 1.0);
  if (c * side.cos_gamma + s * side.sin_gamma <= 0.0) return c > 0.0 && side.sin_gamma < 0.0 ? 1.0 : (s > 0.0 ? 1.0 : 0.0);
  float cos_2theta_gamma = (2.0 * c * c - 1.0) * side.cos_gamma + 2.0 * s * c * side.sin_gamma;
  float value = 0.25 * (side.cos_gamma - cos_2theta_gamma) + 0.5 * arc_cosine(c) * side.sin_gamma;
  return clamp(value * side.inverse_weight, 0.0, 1.0);
}

// Sectors hidden by the solid seen through one pixel. f: its front end relative to x; e: unit direction away from the
// eye (both along d, v); thickness: world units along e.
uint hidden(Side side, vec2 f, vec2 e, float thickness, float dither) {
  float b = dot(f, e);
  float disc = b * b - dot(f, f) + radius * radius;
  if (disc <= 0.0) return 0u;
  float root = sqrt(disc);
  float from = max(-b - root, 0.0), to = min(root - b, thickness);
  if (!(from < to)) return 0u;
  uint first = uint(share(side, f + from * e) * 32.0 + dither), last = uint(share(side, f + to * e) * 32.0 + dither);
  first = min(first, 32u);
  last = min(last, 32u);
  if (last <= first) return 0u;
  return (0xffffffffu >> (32u - (last - first))) << first;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 texel = pixel * STRIDE + guard;
  vec4 own = texelFetch(surface, texel, 0);
  if (own.x == 0.0) {
    result = vec4(0.0);
    return;
  }
  vec3 x = reconstruct(vec2(texel) + 0.5, own.x);
  vec3 normal = normal_at(texel);
  vec3 v = -normalize(x);
  mat3 across = frame(v);
  vec2 noise = block_noise(pixel);
  vec3 start = vec3(vec2(texel) + 0.5, 1.0) / own.x;
  float hidden_weight = 0.0, total = 0.0;
  float shift = noise.y;
  for (int k = 0; k < SLICES; ++k) {
    float phi = PI * (float(k) + noise.x) / float(SLICES);
    vec3 d = cos(phi) * across[0] + sin(phi) * across[1];
    vec3 axis = cross(d, v);
    vec3 projected = normal - axis * dot(normal, axis);
    float n_length = length(projected);
    float cos_gamma = clamp(dot(projected, v) / max(n_length, 1e-6), 0.0, 1.0);
    float gamma = arc_cosine(cos_gamma);
    if (dot(projected, d) < 0.0) gamma = -gamma;
    float sin_gamma = sin(gamma);
    for (int half_slice = 0; half_slice < 2; ++half_slice) {
      float sign = half_slice == 0 ? 1.0 : -1.0;
      float weight = side_weight(cos_gamma, sign * sin_gamma, sign * gamma);
      total += n_length * weight;
      // The horizon is nearly along v: next to nothing to see, and the arc cosine's error is more than half a sector of it.
      if (weight < 5e-3) continue;
      Side side = Side(cos_gamma, sign * sin_gamma, 1.0 / weight);
      vec3 along = homogeneous(sign * radius * d);
      uint mask = 0u;
      for (int j = 0; j < TAPS; ++j) {
        float t = (float(j) + shift) / float(TAPS);
        t *= sqrt(t);
        vec3 h = start + t * along;
        vec2 q = h.xy / h.z;
        ivec2 at = ivec2(floor(q));
        if (!(h.z > 0.0) || !inside(at) || at == texel) continue;
        vec4 s = texelFetch(surface, at, 0);
        float front = s.x + dot(s.yz, q - vec2(at) - 0.5);
        if (!(front > 0.0)) continue;
        vec3 ray = vec3(q * ray_scale + ray_offset, -1.0);
        float ray_length = length(ray);
        vec3 e = ray / ray_length;
        vec2 e2 = vec2(sign * dot(e, d), dot(e, v));
#if LAYERS > 2
        vec4 s2 = texelFetch(surface2, at, 0);
        vec2 solids[3] = vec2[3](vec2(front, s.w), s2.xy, s2.zw);
#else
        vec2 solids[1] = vec2[1](vec2(front, s.w < s.x * 0.9999 ? s.w : 0.0));
#endif
        for (int k = 0; k < solids.length(); ++k) {
          if (!(solids[k].x > 0.0)) continue;
          vec3 f = ray / solids[k].x - x;
          float thickness = solids[k].y > 0.0 ? (1.0 / solids[k].y - 1.0 / solids[k].x) * ray_length : 1e30;
          mask |= hidden(side, vec2(sign * dot(f, d), dot(f, v)), e2, thickness, 0.5);
        }
      }
      hidden_weight += n_length * weight * (float(bitCount(mask)) / 32.0);
      shift = fract(shift + 0.6180339887);
    }
  }
  result = vec4(total > 0.0 ? 1.0 - hidden_weight / total : 1.0, own.x, 0.0, 0.0);
}
