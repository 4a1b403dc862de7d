// Whether anything is in reach of some rays: their origins' half balls of radius max_distance, on the side that they look to. Where
// nothing is, every ray is open and none needs to be traced.
//
// The rays start in a cube about the first one's origin, and n . d >= rise for each, n being the first one's normal and rise at most
// REACH_HORIZON: the half ball but for a thousandth of a radian above its horizon, where AO has a millionth of its weight, and all rays
// themselves. A triangle of vertices v is out of reach if, with g the distance of its box from the cube,
//   g > max_distance   or   n . (v - o) < rise max(g, min_distance) for each v and o        (rise max_distance, where rise < 0):
// a ray's point o + t d in it would have t >= g, n . t d >= rise t. A box is out of reach by the same only if all triangles in it are.
//
// What that must allow for, with e = 2^-24, and A the largest coordinate of the v - o of a triangle and one of the origins:
//   Vertices. triangle_occludes() and triangle_nearer() decide by the signs of differences of products of sheared coordinates
//     x + shear z, with |shear| <= 1; which signs are exact, but that unequal products may round to the same: coordinates 2 e apart. The
//     differences v - o and the fma are rounded. So a ray that meets a triangle truly meets one whose vertices are off, along the two
//     axes i that are not the ray's longest, by up to 4 e (A + |(v - o)_i|): n . v by 4 e (A n2 + s), where n2 is the sum of the two
//     largest |n_i| and s that of all |n_i (v - o)_i|. A is at most the box's own extent and its distance from o; the latter's share is
//     taken off rise.
//   Direction. The shear is off by 6 e of itself (OpenCL's division), n . d as it is computed here by 3 e.
//   n . (v - o) and n . o are off by 4 e s each, as the difference, three products and two sums make them.
//   Distance. g and t are off by the vertices' 12 e A and by roundings of their own, below 16 e of themselves.
//   min_distance moves origins, whose sums are off by 2 e (|o| + max_distance) an axis.
// Where the float test cannot tell, plane_distance() does (near.cl), which is off by less. Origins are off their own triangles by 16 e A,
// or where A is beyond the point's coordinates by so much of these (offset_origin): then their own triangle may be in reach.
#ifndef NOOK_REACH_TESTS_CL
#define NOOK_REACH_TESTS_CL

#include "config.h"
#include "trace/lane_lists.cl"
#include "trace/traverse.cl"

#define REACH_HORIZON 1e-3f

typedef struct {
  float3 origin;      // the first ray's; the rest is relative to it
  float3 normal;
  float spread;       // half the cube's side
  float lowest;       // least n . o, less its error
  float rise;
  float nearest, farthest;  // min_distance, max_distance
  float of_vertices;  // 4 e n2
  float of_place;     // 8 e |n|_1
} Reach;

// The reach of `rays` (at least one). normal: unit; n . d >= 0 but for rounding, at the point it belongs to.
INLINE void reach_of(const RayDirections* origins, const RayDirections* d, uint rays, bool one_origin, float3 normal, float min_distance,
                     float max_distance, Reach* r) {
  r->origin = ray_direction(origins, LOWEST_BIT(rays));
  r->normal = normal;
  float16 rise = REACH_HORIZON, lowest = 0.0f, spread = 0.0f;
  for (uint first = 0; first < 32u && rays >> first; first += 16u) {
    const int16 lanes = lanes_of(rays >> first);
    const float16 v = normal.x * vload16(0, d->x + first) + normal.y * vload16(0, d->y + first) + normal.z * vload16(0, d->z + first);
    rise = (lanes & (v < rise)) ? v : rise;
    if (one_origin) continue;
    const float16 x = vload16(0, origins->x + first) - r->origin.x, y = vload16(0, origins->y + first) - r->origin.y,
                  z = vload16(0, origins->z + first) - r->origin.z;
    const float16 height = normal.x * x + normal.y * y + normal.z * z;
    const float16 terms = fabs(normal.x * x) + fabs(normal.y * y) + fabs(normal.z * z);
    const float16 low = height - 4.768372e-7f * terms;
    lowest = (lanes & (low < lowest)) ? low : lowest;
    const float16 ax = fabs(x), ay = fabs(y), az = fabs(z), axy = ax > ay ? ax : ay, most = axy > az ? axy : az;
    spread = (lanes & (most > spread)) ? most : spread;
  }
  r->rise = least_lane(rise) - 3e-6f;
  r->lowest = one_origin ? 0.0f : least_lane(lowest);
  r->spread = one_origin ? 0.0f : most_lane(spread);
  r->nearest = min_distance;
  r->farthest = max_distance;
  const float3 n = fabs(normal), o = fabs(r->origin);
  const float sum = n.x + n.y + n.z;
  r->of_vertices = 2.384186e-7f * (sum - fmin(n.x, fmin(n.y, n.z)));
  r->of_place = 4.768372e-7f * sum;
  if (min_distance > 0.0f) r->lowest -= r->of_place * (fmax(o.x, fmax(o.y, o.z)) + max_distance);
}

// Of boxes [lo, hi] relative to the origin, an axis at a time: `size` the largest coordinate, `extent` of the boxes themselves, `apart`
// g², `gap` the distance along one axis, which is less than g.
#define BOX_AXIS(lo, hi)                                                               \
  {                                                                                    \
    const REACH_FLOAT outer = (lo) > -(hi) ? (lo) : -(hi), between = outer - r->spread; \
    gap = between > gap ? between : gap;                                               \
    apart += between > 0.0f ? between * between : 0.0f;                                \
    const REACH_FLOAT p = fabs(lo), q = fabs(hi), far = p > q ? p : q;                 \
    size = far > size ? far : size;                                                    \
    extent = (hi) - (lo) > extent ? (hi) - (lo) : extent;                              \
  }
// `high`: the greatest n . (v - o); of_place: its error. A comparison with a NaN leaves things in reach.
#define OUT_OF_REACH(of_place)                                                                            \
  const REACH_FLOAT limit = r->farthest + 2e-6f * (r->farthest + size + r->spread);                      \
  const REACH_FLOAT least = gap - 2e-6f * (size + r->spread), t = least > r->nearest ? least : r->nearest; \
  const REACH_FLOAT height = r->lowest + r->rise * (r->rise < 0.0f ? limit : t);                         \
  const REACH_FLOAT largest = size + (r->spread + r->nearest), a = largest < extent ? largest : extent;  \
  const REACH_INT out = (apart > limit * limit) | (high < height - r->of_vertices * a - (of_place));

// The children of a node that may be in reach; `inside`: one of them surely is, for a whole side of its box is, which a triangle touches.
INLINE uint children_in_reach(TREE_NODE* node, const Reach* r, bool* inside) {
#define REACH_FLOAT node_float
#define REACH_INT node_int
  node_float apart = 0.0f, gap = 0.0f, size = 0.0f, extent = 0.0f;
  node_float high = 0.0f, low = 0.0f, beyond = 0.0f, rise = 0.0f;
#define AXIS(axis, index)                                              \
  {                                                                    \
    const node_float lo = LOAD_NODE(node->lo[index]) - r->origin.axis; \
    const node_float hi = LOAD_NODE(node->hi[index]) - r->origin.axis; \
    BOX_AXIS(lo, hi)                                                   \
    const node_float x = r->normal.axis * lo, y = r->normal.axis * hi; \
    high += x > y ? x : y;                                             \
    low += x > y ? y : x;                                              \
    const node_float p = fabs(lo), q = fabs(hi), far = p > q ? p : q;  \
    beyond += far * far;                                               \
    const node_float along = fabs(y - x);                              \
    rise = along > rise ? along : rise;                                \
  }
  AXIS(x, 0)
  AXIS(y, 1)
  AXIS(z, 2)
#undef AXIS
  OUT_OF_REACH(r->of_place * size)
  const uint filled = NONZERO_CHILDREN(LOAD_NODE(node->lo[0]) < INFINITY);
  *inside = (NONZERO_CHILDREN((beyond < r->farthest * r->farthest) & (low + rise > 0.0f)) & filled) != 0;
  return NONZERO_CHILDREN(out == 0) & filled;
#undef REACH_FLOAT
#undef REACH_INT
}

// Whether a triangle of the leaf may be in reach.
INLINE bool leaf_in_reach(TREE_LEAF* leaf, const Reach* r) {
#define REACH_FLOAT leaf_float
#define REACH_INT leaf_int
  leaf_float apart = 0.0f, gap = 0.0f, size = 0.0f, extent = 0.0f;
  leaf_float sum = 0.0f, high_0 = 0.0f, high_1 = 0.0f, high_2 = 0.0f;
#define AXIS(axis, index)                                                                             \
  {                                                                                                   \
    const float16 points = vload16(0, leaf->p[index]) - r->origin.axis;                               \
    const leaf_float a = FIRST_CORNERS(points), b = SECOND_CORNERS(points), c = THIRD_CORNERS(points); \
    high_0 += r->normal.axis * a, high_1 += r->normal.axis * b, high_2 += r->normal.axis * c;         \
    const leaf_float least = a < b ? a : b, most = a > b ? a : b;                                     \
    const leaf_float lo = least < c ? least : c, hi = most > c ? most : c;                            \
    BOX_AXIS(lo, hi)                                                                                  \
    sum += fabs(r->normal.axis) * (fabs(lo) > fabs(hi) ? fabs(lo) : fabs(hi));                        \
  }
  AXIS(x, 0)
  AXIS(y, 1)
  AXIS(z, 2)
#undef AXIS
  const leaf_float higher = high_0 > high_1 ? high_0 : high_1, high = higher > high_2 ? higher : high_2;
  OUT_OF_REACH(4.768372e-7f * sum)
  const leaf_int filled = LOAD_LEAF(leaf->triangle) != BVH_EMPTY;
  return OR_LEAF_LANES((out == 0) & filled) != 0;
#undef REACH_FLOAT
#undef REACH_INT
}

#endif
