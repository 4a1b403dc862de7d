// Writes one depth layer: the FRONT layer, the back layer behind it, or, when PEELed, the next face behind those peeled before,
// be it a front or a back face. Inverse depth is affine over the screen for a plane, so (w, dw/dx, dw/dy) is the tangent plane
// of the surface in the pixel: at an offset of d pixels its inverse depth is w + dot(d, gradient).
#if NORMAL
NORMAL_KIND in vec3 view_normal;
#endif
#if EXACT
in vec3 view_position;
#endif

// rgb: inverse depth of the front layer and its gradient; a: inverse depth of the back layer, or, where faces are peeled, 1 for a
// front face and -1 for a back face. PEEL: inverse depth, negative for a back face, in each channel.
layout(location = 0) out vec4 surface;
#if NORMAL
layout(location = 1) out vec2 normal;  // view space, octahedral; as the ray tracer's shading normal: never flipped
#endif
#if EXACT
layout(location = 2) out vec4 position;      // view space; w = 1 marks coverage
layout(location = 3) out vec4 exact_normal;  // view space, unit; w = 1 marks coverage
#endif

#if PEEL
uniform sampler2D peeled;  // reversed depth of the face peeled last
#endif

#if NORMAL
uniform vec2 ray_scale, ray_offset;  // see host/ssao/view.hpp

// The plane n x = 1 through the pixel's surface, x = (q ray_scale + ray_offset, -1) / w, has dw/dq = n.xy ray_scale and
// w = dot(n, (q ray_scale + ray_offset, -1)).
vec3 geometric_normal(float w, vec2 gradient) {
  vec2 n = gradient / ray_scale;
  vec3 away = vec3(n, dot(n, gl_FragCoord.xy * ray_scale + ray_offset) - w);
  return normalize(gl_FrontFacing ? -away : away);
}

// The octahedral map (Cigolle et al. 2014, "A survey of efficient representations for independent unit vectors"), in
// [0,1]² such that 0 is a multiple of 1/65535 and so exact; normal_at() in view.glsl is its inverse.
vec2 octahedral(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return ((n.z < 0.0 ? folded : n.xy) + 1.0) * (32767.0 / 65535.0);
}
#endif

void main() {
  float w = gl_FragCoord.w;
#if PEEL
  if (!(gl_FragCoord.z < texelFetch(peeled, ivec2(gl_FragCoord.xy), 0).x)) discard;
  surface = vec4(gl_FrontFacing ? w : -w);
#elif FRONT
  vec2 gradient = vec2(dFdx(w), dFdy(w));
  surface = vec4(w, gradient, gl_FrontFacing ? 1.0 : -1.0);
#else
  surface = vec4(0.0, 0.0, 0.0, w);
#endif
#if NORMAL
  // Vertex normals that cancel leave none.
  bool usable = dot(view_normal, view_normal) > 1e-12;
  vec3 n = usable ? normalize(view_normal) : geometric_normal(w, gradient);
  normal = octahedral(n);
#if EXACT
  position = vec4(view_position, 1.0);
  exact_normal = vec4(n, 1.0);
#endif
#endif
}
