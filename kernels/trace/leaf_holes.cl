// Cut-outs within a leaf, for every traversal alike: the hit's place is computed again from its triangle, so that an any-hit test that
// keeps no barycentrics needs none.
#ifndef NOOK_LEAF_HOLES_CL
#define NOOK_LEAF_HOLES_CL

#include "trace/cut_out.cl"
#include "trace/intersect.cl"
#include "trace/rays.cl"

#if CUT_OUTS

// Whether the ray o + t d, which meets the lane's triangle, goes through a hole in it.
bool lane_in_hole(CUT_PARAMS, TREE_LEAF* leaf, uint lane, float3 o, float3 d) {
  const RayShear shear = shear_ray(d);
  const ShearedTriangle t =
      shear_triangle(o, &shear, leaf_vertex(leaf, 0, lane), leaf_vertex(leaf, 1, lane), leaf_vertex(leaf, 2, lane));
  return IN_HOLE(STORED_TRIANGLE(leaf, lane), t.wb / t.det, t.wc / t.det);
}

#define LANE_IN_HOLE(leaf, lane, o, d) lane_in_hole(CUT_ARGS, leaf, lane, o, d)
#else
#define LANE_IN_HOLE(leaf, lane, o, d) false
#endif

#endif
