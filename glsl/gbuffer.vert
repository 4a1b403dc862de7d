// Projects the mesh. Depth is reversed (near/depth, cleared to 0): a float buffer then resolves every depth equally
// well relative to its size, with no far plane.
layout(location = 0) in vec3 world_position;
layout(location = 1) in vec3 world_normal;

uniform vec3 eye, right, up, backward;  // the view frame, world space
uniform vec2 ray_scale, ray_offset;     // see host/ssao/view.hpp
uniform vec2 buffer_size;               // pixels
uniform float near;                     // world units

invariant gl_Position;  // faces are peeled by comparing the depths of several programs

#if NORMAL
NORMAL_KIND out vec3 view_normal;  // smooth: not normalised
#endif
#if EXACT
out vec3 view_position;
#endif

void main() {
  vec3 p = world_position - eye;
  vec3 view = vec3(dot(right, p), dot(up, p), dot(backward, p));
  float depth = -view.z;
  // Buffer coordinates times depth; the window's origin is the upper left corner (glClipControl).
  vec2 scaled = (view.xy - ray_offset * depth) / ray_scale;
  vec2 ndc = 2.0 * scaled / buffer_size - depth;
  gl_Position = vec4(ndc.x, -ndc.y, near, depth);
#if NORMAL
  view_normal = vec3(dot(right, world_normal), dot(up, world_normal), dot(backward, world_normal));
#endif
#if EXACT
  view_position = view;
#endif
}
