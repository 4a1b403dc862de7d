// Opacity maps (map_d) and where each triangle lies in them.
#ifndef NOOK_SHARED_CUT_OUT_H
#define NOOK_SHARED_CUT_OUT_H

#include "portable.h"

#define NO_OPACITY_MAP 0xffffffffu

// Read as:
//   if (triangle.map != NO_OPACITY_MAP) the hit (1-u-v) p0 + u p1 + v p2 lies at (1-u-v) uv[0] + u uv[1] + v uv[2] of that map
typedef struct {
  float uv[3][2];       // of the corners; v = 0 is the map's lower edge
  nook_uint map;        // an index, or NO_OPACITY_MAP: opaque
  nook_uint reserved;
} CutTriangle;

// Read as:
//   opacity[first + y * width + x] / 255, row 0 at the top
typedef struct {
  nook_uint first;
  nook_uint width, height;  // texels, at least 1
  nook_uint clamped;        // 1: opaque outside 0 to 1; 0: the map repeats
} OpacityMapPlace;

#ifdef __OPENCL_C_VERSION__
// What a kernel passes through: the buffers of CutOuts, in this order.
#define CUT_PARAMS \
  __global const CutTriangle *cut_triangles, __global const OpacityMapPlace *opacity_maps, __global const uchar *opacity
#define CUT_ARGS cut_triangles, opacity_maps, opacity
#endif

#endif
