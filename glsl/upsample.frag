// Full resolution from half: the four half-resolution pixels around a pixel, by bilinear weights times how well their
// depth lies on the pixel's tangent plane. Where none does, the one nearest to the plane.
layout(location = 0) out vec4 result;  // AO, inverse depth

uniform sampler2D occlusion;  // half resolution: AO, inverse depth
uniform ivec2 image_size;     // of `occlusion`

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 s = texelFetch(surface, pixel + guard, 0);
  if (s.x == 0.0) {
    result = vec4(0.0);
    return;
  }
  ivec2 corner = pixel >> 1;
  float scale = 1.0 / (s.x * DEPTH_TOLERANCE);
  float sum = 0.0, weights = 0.0, nearest = 1e30, nearest_value = 1.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 step = ivec2(k & 1, k >> 1);
    ivec2 at = min(corner + step, image_size - 1);
    vec2 other = texelFetch(occlusion, at, 0).xy;
    vec2 offset = vec2(2 * at - pixel);
    vec2 bilinear = max(1.0 - 0.5 * abs(offset), 0.0);
    float off = other.y == 0.0 ? 1e20 : abs(other.y - (s.x + dot(s.yz, offset))) * scale;
    float weight = bilinear.x * bilinear.y * max(0.0, 1.0 - off);
    sum += weight * other.x;
    weights += weight;
    if (off < nearest) {
      nearest = off;
      nearest_value = other.x;
    }
  }
  result = vec4(weights > 1e-3 ? sum / weights : nearest_value, s.x, 0.0, 0.0);
}
