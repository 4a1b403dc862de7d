// A full-screen quad.
layout(location = 0) in vec2 quad_position;  // clip space
layout(location = 1) in vec2 quad_uv;

out vec2 uv;  // [0,1]², row 0 at the top

void main() {
  gl_Position = vec4(quad_position, 0.0, 1.0);
  uv = quad_uv;
}
