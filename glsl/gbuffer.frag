// Writes one depth layer. Inverse depth is affine over the screen for a plane, so (w, dw/dx, dw/dy) is the tangent plane
// of the surface in the pixel: at an offset of d pixels its inverse depth is w + dot(d, gradient).
in vec3 view_normal;
#if WRITE_POSITION
in vec3 view_position;
#endif

layout(location = 0) out vec4 surface;  // rgb: inverse depth of the front layer and its gradient; a: of the back layer
layout(location = 1) out vec4 normal;   // view space, unit, as the path tracer's shading normal: never flipped
#if WRITE_POSITION
layout(location = 2) out vec4 position;  // view space; w = 1 marks coverage
#endif

#if SOME_WITHOUT_NORMALS
uniform samplerBuffer triangle_normals;  // geometric, world space
uniform vec3 right, up, backward;
#endif
#if PEEL
uniform sampler2D nearer;  // the surface texture of the first two layers
#endif

void main() {
  float w = gl_FragCoord.w;
#if PEEL
  // Only what lies behind the first two layers; the margin keeps a surface from being found twice.
  vec4 before = texelFetch(nearer, ivec2(gl_FragCoord.xy), 0);
  float last = before.a > 0.0 ? before.a : before.r;
  if (!(w < last * (1.0 - 1e-5))) discard;
#endif
#if BACK
  surface = vec4(0.0, 0.0, 0.0, w);
  normal = vec4(0.0);
#else
  surface = vec4(w, dFdx(w), dFdy(w), 0.0);
  vec3 n = view_normal;
#if SOME_WITHOUT_NORMALS
  if (!(dot(n, n) > 1e-12)) {
    vec3 g = texelFetch(triangle_normals, gl_PrimitiveID).xyz;
    n = vec3(dot(right, g), dot(up, g), dot(backward, g));
  }
#endif
  normal = vec4(normalize(n), 1.0);
#if WRITE_POSITION
  position = vec4(view_position, 1.0);
#endif
#endif
}
