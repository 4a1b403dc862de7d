// Writes one depth layer: a front layer with its NORMAL, or the back layer behind it without. Inverse depth is affine
// over the screen for a plane, so (w, dw/dx, dw/dy) is the tangent plane of the surface in the pixel: at an offset of d
// pixels its inverse depth is w + dot(d, gradient).
#if NORMAL
NORMAL_KIND in vec3 view_normal;
#endif
#if WRITE_POSITION
in vec3 view_position;
#endif

layout(location = 0) out vec4 surface;  // rgb: inverse depth of the front layer and its gradient; a: of the back layer
layout(location = 1) out vec4 normal;  // view space, unit, as the path tracer's shading normal: never flipped
#if WRITE_POSITION
layout(location = 2) out vec4 position;  // view space; w = 1 marks coverage
#endif

#if PEEL
uniform sampler2D nearer;  // the surface texture of the first two layers
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
#endif

void main() {
  float w = gl_FragCoord.w;
#if PEEL
  // Only what lies behind the first two layers; the margin keeps a surface from being found twice.
  vec4 before = texelFetch(nearer, ivec2(gl_FragCoord.xy), 0);
  float last = before.a > 0.0 ? before.a : before.r;
  if (!(w < last * (1.0 - 1e-5))) discard;
#endif
#if !NORMAL
  surface = vec4(0.0, 0.0, 0.0, w);
  normal = vec4(0.0);
#else
  vec2 gradient = vec2(dFdx(w), dFdy(w));
  surface = vec4(w, gradient, 0.0);
  // Vertex normals that cancel leave none.
  bool usable = dot(view_normal, view_normal) > 1e-12;
  normal = vec4(usable ? normalize(view_normal) : geometric_normal(w, gradient), 1.0);
#if WRITE_POSITION
  position = vec4(view_position, 1.0);
#endif
#endif
}
