// What of each pixel's view ray is solid, from its faces in the order of depth (host/ssao/geometry_pass.hpp). A front
// face opens a solid, and the back face that closes it follows. They pair off as brackets do:
//   ( ( ) )  bodies that lie or pass into one another: one solid from the first to the last,
//   ( (  )   a face too many: the open sheet in front, and a solid.
// A face without a partner is a sheet. So is a back face that nothing opened, seen from inside. Behind the last face of
// all nothing is known: if it opens a solid, that has no end. Sheets and solids are made as thick as a ray's step, away
// from the side that the face looks to, or the ray would step over them. Solids that overlap are one; the first three
// of a ray are kept.
layout(location = 0) out vec4 result;   // inverse depth of what is visible, its gradient, inverse depth where its solid ends; 0: nowhere
layout(location = 1) out vec4 result2;  // the second solid's beginning and end, the third's

uniform sampler2D first;         // inverse depth, its gradient; a: 1 for a front face, -1 for a back face
uniform sampler2D next4, next8;  // inverse depths of the following faces, negative for back faces; 0: none
uniform float thickness;         // world units, at least

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 visible = texelFetch(first, texel, 0);
  result = result2 = vec4(0.0);
  if (visible.x == 0.0) return;
  vec4 a = texelFetch(next4, texel, 0), b = texelFetch(next8, texel, 0);
  float face[9] = float[9](visible.x * visible.a, a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);

  float end[FACES];  // depth where what a face opens ends; a back face by itself is a sheet; 0: the end of another's
  int open[FACES];   // front faces without a partner so far
  int opened = 0, count = 0;
  for (; count < FACES && face[count] != 0.0; ++count) {
    end[count] = 1.0 / abs(face[count]);
    if (face[count] > 0.0) {
      open[opened++] = count;
    } else if (opened > 0) {
      end[open[--opened]] = end[count];
      end[count] = 0.0;
    }
  }
  bool endless = count < FACES && face[count - 1] > 0.0;

  float begin_of[3], end_of[3];
  int solids = 0;
  for (int i = 0; i < count; ++i) {
    if (end[i] == 0.0) continue;
    float at = 1.0 / abs(face[i]), from = at, to = max(end[i], at + thickness);
    if (face[i] < 0.0) {
      from = max(at - thickness, 1e-30);  // not behind the eye
      to = at;
    }
    if (endless && i == count - 1) to = 1e30;
    if (solids > 0 && from <= end_of[solids - 1]) {
      end_of[solids - 1] = max(end_of[solids - 1], to);
    } else if (solids < 3) {
      begin_of[solids] = from;
      end_of[solids++] = to;
    }
  }
  for (int i = solids; i < 3; ++i) begin_of[i] = end_of[i] = 1e30;
  if (visible.a > 0.0) {
    result = vec4(visible.xyz, 1.0 / end_of[0]);
    result2 = 1.0 / vec4(begin_of[1], end_of[1], begin_of[2], end_of[2]);
  } else {
    result = vec4(visible.xyz, visible.x);
    result2 = 1.0 / vec4(begin_of[0], end_of[0], begin_of[1], end_of[1]);
  }
}
