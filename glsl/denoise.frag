// One direction of a separable bilateral filter over AO: a neighbour counts as far as its depth lies on the tangent
// plane of the pixel, so that nothing is averaged across an edge, and BY_NORMAL as far as its normal agrees.
layout(location = 0) out vec4 result;  // AO, inverse depth

uniform sampler2D occlusion;  // AO, inverse depth
uniform ivec2 direction;      // (1,0) or (0,1)
uniform ivec2 image_size;     // pixels of `occlusion`

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 own = texelFetch(occlusion, pixel, 0).xy;
  if (own.y == 0.0) {
    result = vec4(0.0);
    return;
  }
  vec4 s = texelFetch(surface, pixel * STRIDE + guard, 0);
  float gradient = dot(s.yz, vec2(direction)) * float(STRIDE);
  // How far a neighbour may be off the plane, in inverse depth: a few pixels' worth of the plane's own slope, at least.
  float scale = 1.0 / (own.y * DEPTH_TOLERANCE);
#if BY_NORMAL
  vec3 normal = normal_at(pixel * STRIDE + guard);
#endif
  float sum = own.x, weights = 1.0;
  for (int k = -DENOISE_RADIUS; k <= DENOISE_RADIUS; ++k) {
    if (k == 0) continue;
    ivec2 at = pixel + k * direction;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, image_size))) continue;
    vec2 other = texelFetch(occlusion, at, 0).xy;
    float off = abs(other.y - (own.y + float(k) * gradient)) * scale;
    float weight = max(0.0, 1.0 - off);
    if (other.y == 0.0) weight = 0.0;
#if BY_NORMAL
    float bend = 1.0 - dot(normal, normal_at(at * STRIDE + guard));
    weight *= max(0.0, 1.0 - bend * (1.0 / NORMAL_TOLERANCE));
#endif
#if HALF_ENDS
    if (k == -DENOISE_RADIUS || k == DENOISE_RADIUS) weight *= 0.5;
#endif
    sum += weight * other.x;
    weights += weight;
  }
  result = vec4(sum / weights, own.y, 0.0, 0.0);
}
