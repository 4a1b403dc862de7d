// Ambient occlusion by marching: N directions, cosine-weighted, so that
//   AO(x) = 1/pi int V(x, w) cos(theta) dw  ~  1/N sum_i V(x, w_i).
// Each is followed through the buffer up to the radius in STEPS steps, which are shorter near x; the last is at the
// radius itself. A step at inverse depth w over the pixel with front layer f and back layer b is inside a solid if
// b < w < f. f is the value of that pixel's tangent plane at the step's own position, so that a surface never occludes
// itself however steeply it is seen. Without a back layer (an open sheet) everything behind the front layer is solid.
// Rules: background pixels are 0 with coverage 0; a ray that leaves the buffer or passes the eye is open.
layout(location = 0) out vec4 result;  // AO, inverse depth

uniform float radius;  // world units
#if LAYERS > 2
uniform sampler2D surface2;  // where the second and third solid begin and end
#endif

bool in_solid(ivec2 at, float w, vec2 offset) {
  vec4 s = texelFetch(surface, at, 0);
  float front = s.x + dot(s.yz, offset);
#if LAYERS > 2
  vec4 s2 = texelFetch(surface2, at, 0);
  return (w < front * (1.0 - TOLERANCE) && w > s.w) || (w < s2.x && w > s2.y) || (w < s2.z && w > s2.w);
#else
  float back = s.w < s.x * 0.9999 ? s.w : 0.0;
  return w < front * (1.0 - TOLERANCE) && w > back;
#endif
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
  mat3 to_view = frame(normal_at(texel));
  vec2 noise = block_noise(pixel);
  float shift = fract(noise.x + 0.5 * noise.y);
  // A ray is start + t along in homogeneous buffer coordinates: one matrix a pixel turns directions into `along`.
  vec3 start = vec3(vec2(texel) + 0.5, 1.0) / own.x;
  mat3 to_buffer = radius * mat3(homogeneous(to_view[0]), homogeneous(to_view[1]), homogeneous(to_view[2]));
  float turn = 2.0 * PI * noise.x;
  mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  float open = 0.0;
  for (int i = 0; i < DIRECTIONS; ++i) {
    float u = (float(i) + noise.y) * (1.0 / float(DIRECTIONS));
    float golden = 2.0 * PI * fract(0.6180339887 * float(i));
    vec2 azimuth = turned * vec2(cos(golden), sin(golden));
    vec3 along = to_buffer * vec3(sqrt(u) * azimuth, sqrt(1.0 - u));
    // No early end: eight pixels run together, and seldom end together. Fetches outside are defined, and ignored.
    bool hidden = false;
    for (int j = 0; j < STEPS; ++j) {
      float t = min((float(j) + shift) * (1.0 / float(STEPS - 1)), 1.0);
      vec3 h = start + (t * sqrt(t)) * along;
      float w = 1.0 / h.z;
      vec2 q = h.xy * w;
      ivec2 at = ivec2(floor(q));
      vec2 offset = q - vec2(at) - 0.5;
      bool solid = in_solid(at, w, offset);
      hidden = hidden || (solid && h.z > 0.0 && inside(at));
    }
    open += hidden ? 0.0 : 1.0;
    shift = fract(shift + 0.6180339887);
  }
  result = vec4(open / float(DIRECTIONS), own.x, 0.0, 0.0);
}
