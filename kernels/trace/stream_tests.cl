// One ray of a stream against all children of a node, or all triangles of a leaf: they are the vectors' lanes.
#ifndef NOOK_STREAM_TESTS_CL
#define NOOK_STREAM_TESTS_CL

#include "trace/leaf_holes.cl"
#include "trace/stream_rays.cl"

// enter_box() for all children of a node: entry distances, and lanes of -1 where ray k meets the child within [0, limit].
INLINE node_int enter_children(TREE_NODE* node, const StreamRays* r, uint k, float limit, node_float* entry) {
  TREE_FLOATS* planes = &node->lo[0][0];
  const uint nx = r->near_x[k], ny = r->near_y[k], nz = r->near_z[k];
  const uint fx = HI_PLANES - nx, fy = HI_PLANES + 2u * BVH_WIDTH - ny, fz = HI_PLANES + 4u * BVH_WIDTH - nz;
  const float ox = r->ox[k], oy = r->oy[k], oz = r->oz[k];
  const node_float ax = (LOAD_NODE(planes + nx) - ox) * r->ix[k];
  const node_float ay = (LOAD_NODE(planes + ny) - oy) * r->iy[k];
  const node_float az = (LOAD_NODE(planes + nz) - oz) * r->iz[k];
  const node_float bx = (LOAD_NODE(planes + fx) - ox) * r->ix[k];
  const node_float by = (LOAD_NODE(planes + fy) - oy) * r->iy[k];
  const node_float bz = (LOAD_NODE(planes + fz) - oz) * r->iz[k];
  node_float enter = 0.0f, leave = limit;
  enter = ax > enter ? ax : enter;
  leave = bx < leave ? bx : leave;
  enter = ay > enter ? ay : enter;
  leave = by < leave ? by : leave;
  enter = az > enter ? az : enter;
  leave = bz < leave ? bz : leave;
  *entry = enter;
  return enter <= leave * FAR_PLANE_GROWTH;
}

// shear_triangle() and inside() for all triangles of a leaf.
typedef struct {
  leaf_float wb, wc, det, height;
  leaf_int inside;
} ShearedLeaf;

INLINE void shear_leaf(ShearedLeaf* t, TREE_LEAF* leaf, const StreamRays* r, uint k) {
  TREE_FLOATS* points = &leaf->p[0][0];
  const float16 z = vload16(0, points + r->row_z[k]) - r->row_oz[k];
  const float16 x = fma(r->shear_x[k], z, vload16(0, points + r->row_x[k]) - r->row_ox[k]);
  const float16 y = fma(r->shear_y[k], z, vload16(0, points + r->row_y[k]) - r->row_oy[k]);
  const leaf_float ax = FIRST_CORNERS(x), ay = FIRST_CORNERS(y), az = FIRST_CORNERS(z);
  const leaf_float bx = SECOND_CORNERS(x), by = SECOND_CORNERS(y), bz = SECOND_CORNERS(z);
  const leaf_float cx = THIRD_CORNERS(x), cy = THIRD_CORNERS(y), cz = THIRD_CORNERS(z);
  const leaf_float wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
  t->wb = wb;
  t->wc = wc;
  t->det = wa + wb + wc;
  t->height = fma(wa, az, fma(wb, bz, wc * cz));
  const leaf_uint sign = AS_LEAF_UINT(t->det) & SIGN_BIT;
  t->inside = (AS_LEAF_FLOAT(AS_LEAF_UINT(wa) ^ sign) >= 0.0f) & (AS_LEAF_FLOAT(AS_LEAF_UINT(wb) ^ sign) >= 0.0f) &
              (AS_LEAF_FLOAT(AS_LEAF_UINT(wc) ^ sign) >= 0.0f);
}

// triangle_occludes() for all triangles of a leaf: -1 where ray k meets it, else 0. *near: likewise, where near_lanes_occlude() is to tell.
INLINE leaf_int leaf_occludes(TREE_LEAF* leaf, const StreamRays* r, uint k, leaf_int* near) {
  ShearedLeaf t;
  shear_leaf(&t, leaf, r, k);
  const leaf_uint flip = (AS_LEAF_UINT(t.det) ^ as_uint(r->inverse_z[k])) & SIGN_BIT;
  const leaf_float height = AS_LEAF_FLOAT(AS_LEAF_UINT(t.height) ^ flip), far = fabs(t.det) * r->limit_z[k];
  // How far within (0, far) the height is, negative outside; NaN where far is.
  const leaf_float rest = far - height, within = height < rest ? height : rest, least = LOAD_LEAF(leaf->near_height);
  const leaf_int sure = t.inside & (within > least);
  *near = t.inside & (far > 0.0f) & (within >= -least) & ~sure;
  return sure;
}

// Whether ray k meets one of the `lanes` of a leaf, which it is inside of and near.
bool near_lanes_occlude(WITH_CUT_PARAMS TREE_LEAF* leaf, uint lanes, const RayDirections* origins, const RayDirections* d, uint k,
                        float max_distance) {
  const float3 o = ray_direction(origins, k), along = ray_direction(d, k);
  for (; lanes; lanes &= lanes - 1) {
    const uint lane = LOWEST_BIT(lanes);
    if (!plane_within(o, along, leaf_vertex(leaf, 0, lane), leaf_vertex(leaf, 1, lane), leaf_vertex(leaf, 2, lane), max_distance))
      continue;
    if (!LANE_IN_HOLE(leaf, lane, o, along)) return true;
  }
  return false;
}

#if CUT_OUTS
// `met` (-1 where ray k meets a lane's triangle, else 0) without the lanes where it goes through a hole.
INLINE leaf_int without_holes(CUT_PARAMS, TREE_LEAF* leaf, leaf_int met, const RayDirections* origins,
                              const RayDirections* d, uint k) {
  const leaf_int leaf_bits = LEAF_BITS;
  uint open = 0;
  for (uint lanes = (uint)OR_LEAF_LANES(met & leaf_bits); lanes; lanes &= lanes - 1) {
    const uint lane = LOWEST_BIT(lanes);
    if (LANE_IN_HOLE(leaf, lane, ray_direction(origins, k), ray_direction(d, k))) open |= 1u << lane;
  }
  return met & ((leaf_bits & (leaf_int)(int)open) == 0);
}
#define WITHOUT_HOLES(leaf, met, origins, d, k) without_holes(CUT_ARGS, leaf, met, origins, d, k)
#else
#define WITHOUT_HOLES(leaf, met, origins, d, k) ((void)(origins), (void)(d), (met))
#endif

// plane_distance() of a leaf's triangle along ray k.
float lane_distance(TREE_LEAF* leaf, uint lane, const StreamRays* r, uint k) {
  const float3 o = (float3)(r->ox[k], r->oy[k], r->oz[k]), d = (float3)(r->dx[k], r->dy[k], r->dz[k]);
  return plane_distance(o, d, leaf_vertex(leaf, 0, lane), leaf_vertex(leaf, 1, lane), leaf_vertex(leaf, 2, lane));
}

// triangle_nearer() for all triangles of a leaf: the nearest hit of ray k, if it is nearer than *t.
// Of equally near triangles the lowest index, as closest_ray(); none at the limit itself.
INLINE void leaf_nearer(WITH_CUT_PARAMS TREE_LEAF* leaf, const StreamRays* r, uint k, float* t, uint* triangle,
                        float* u, float* v) {
  ShearedLeaf f;
  shear_leaf(&f, leaf, r, k);
  const leaf_float distance = f.height * r->inverse_z[k] / f.det, least = LOAD_LEAF(leaf->near_height);
  const leaf_int near = f.inside & (f.det != 0.0f) & (fabs(f.height) <= (distance < 0.0f ? least : NEAR_HITS * least));
  const leaf_int hit = (f.inside & (distance > 0.0f) & (distance <= *t)) | near;
  uint lanes = (uint)OR_LEAF_LANES(hit & LEAF_BITS);
  if (!lanes) return;
  float distances[BVH_LEAF_WIDTH], lane_wb[BVH_LEAF_WIDTH], lane_wc[BVH_LEAF_WIDTH], lane_det[BVH_LEAF_WIDTH];
  STORE_LEAF(distances, distance);
  for (uint rest = (uint)OR_LEAF_LANES(near & LEAF_BITS); rest; rest &= rest - 1)
    distances[LOWEST_BIT(rest)] = lane_distance(leaf, LOWEST_BIT(rest), r, k);
  STORE_LEAF(lane_wb, f.wb);
  STORE_LEAF(lane_wc, f.wc);
  STORE_LEAF(lane_det, f.det);
  for (; lanes; lanes &= lanes - 1) {
    const uint lane = LOWEST_BIT(lanes);
    const uint id = leaf->triangle[lane];
    const bool nearer = (distances[lane] > 0.0f && distances[lane] < *t) ||
                        (distances[lane] == *t && *triangle != NO_TRIANGLE && id < *triangle);
    if (!nearer || IN_HOLE(STORED_TRIANGLE(leaf, lane), lane_wb[lane] / lane_det[lane], lane_wc[lane] / lane_det[lane])) continue;
    *t = distances[lane];
    *triangle = id;
    *u = lane_wb[lane] / lane_det[lane];
    *v = lane_wc[lane] / lane_det[lane];
  }
}

#endif
