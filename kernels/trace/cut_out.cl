// Holes: a ray goes on where a triangle's opacity map is less than half opaque. The map is interpolated between its texels'
// centres; outside 0 to 1 it repeats or, clamped, is opaque.
#ifndef NOOK_CUT_OUT_CL
#define NOOK_CUT_OUT_CL

#include "config.h"
#include "shared/cut_out.h"

// The two texels on both sides of x (in periods) along an axis of `size` texels, and the second one's share. At the border they
// are the other end's, or both the last one's if the map is clamped.
float texels_beside(float x, uint size, bool clamped, uint* first, uint* second) {
  const float place = (clamped ? x : x - floor(x)) * (float)size - 0.5f;
  const float below = floor(place);
  *first = below < 0.0f ? (clamped ? 0u : size - 1u) : min((uint)below, size - 1u);
  if (clamped)
    *second = below < 0.0f ? 0u : min(*first + 1u, size - 1u);
  else
    *second = *first + 1u == size ? 0u : *first + 1u;
  return place - below;
}

// 0 to 255 at (u, v).
float opacity_at(const OpacityMapPlace map, __global const uchar* opacity, float u, float v) {
  const bool clamped = map.clamped != 0u;
  if (clamped && !(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)) return 255.0f;
  uint x0, x1, y0, y1;
  const float x = texels_beside(u, map.width, clamped, &x0, &x1);
  const float y = texels_beside(1.0f - v, map.height, clamped, &y0, &y1);
  __global const uchar* upper = opacity + map.first + y0 * map.width;
  __global const uchar* lower = opacity + map.first + y1 * map.width;
  const float above = (1.0f - x) * (float)upper[x0] + x * (float)upper[x1];
  const float under = (1.0f - x) * (float)lower[x0] + x * (float)lower[x1];
  return (1.0f - y) * above + y * under;
}

// Whether the point (1-u-v) p0 + u p1 + v p2 of a triangle lies in a hole.
bool in_hole(CUT_PARAMS, uint triangle, float u, float v) {
  __global const CutTriangle* t = cut_triangles + triangle;
  if (t->map == NO_OPACITY_MAP) return false;
  const float w = 1.0f - u - v;
  const float map_u = w * t->uv[0][0] + u * t->uv[1][0] + v * t->uv[2][0];
  const float map_v = w * t->uv[0][1] + u * t->uv[1][1] + v * t->uv[2][1];
  return opacity_at(opacity_maps[t->map], opacity, map_u, map_v) < 127.5f;
}

#if CUT_OUTS
#define IN_HOLE(triangle, u, v) in_hole(CUT_ARGS, triangle, u, v)
#else
#define IN_HOLE(triangle, u, v) false
#endif

#endif
