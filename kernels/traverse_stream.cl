// Many rays go through the tree together; a stack entry is a node and the mask of the rays that meet its box. A node
// visit costs each of its rays one vector slab test for all children, a leaf visit one vector triangle test for all
// triangles.
#ifndef NOOK_TRAVERSE_STREAM_CL
#define NOOK_TRAVERSE_STREAM_CL

#include "intersect.cl"
#include "stream_vector.cl"

// What the tests read of each ray. Offsets count floats.
typedef struct {
  float ox[32], oy[32], oz[32];             // origins
  float ix[32], iy[32], iz[32];             // 1/d
  uint near_x[32], near_y[32], near_z[32];  // BvhNode planes that the ray enters through
  float shear_x[32], shear_y[32];           // RayShear
  uint row_x[32], row_y[32], row_z[32];     // TriangleLeaf.p[0] rows of the RayShear axes
  float row_ox[32], row_oy[32], row_oz[32];  // the origin along them
  float inverse_z[32];                      // 1/d[kz]
  float limit_z[32];                        // max_distance |d[kz]|
} StreamRays;

#define HI_PLANES (3u * BVH_WIDTH)    // BvhNode.hi behind BvhNode.lo
#define VERTEX_ROWS (3u * BVH_LEAF_WIDTH)  // TriangleLeaf.p[1] behind p[0]
#define SIGN_BIT 0x80000000u

// Rays [first, first + 16), as shear_ray() does it for one.
void prepare_rays(StreamRays* r, const RayDirections* origins, const RayDirections* d, uint first, float max_distance) {
  const float16 ox = vload16(0, origins->x + first), oy = vload16(0, origins->y + first), oz = vload16(0, origins->z + first);
  const float16 x = vload16(0, d->x + first), y = vload16(0, d->y + first), z = vload16(0, d->z + first);
  const float16 ix = 1.0f / x, iy = 1.0f / y, iz = 1.0f / z;
  STORE_FLOATS(r->ox + first, ox);
  STORE_FLOATS(r->oy + first, oy);
  STORE_FLOATS(r->oz + first, oz);
  STORE_FLOATS(r->ix + first, ix);
  STORE_FLOATS(r->iy + first, iy);
  STORE_FLOATS(r->iz + first, iz);
  const uint16 hi = HI_PLANES, none = 0u;
  STORE_UINTS(r->near_x + first, as_int16(ix) < 0 ? hi : none);
  STORE_UINTS(r->near_y + first, (as_int16(iy) < 0 ? hi : none) + BVH_WIDTH);
  STORE_UINTS(r->near_z + first, (as_int16(iz) < 0 ? hi : none) + 2u * BVH_WIDTH);
  const float16 ax = fabs(x), ay = fabs(y), az = fabs(z);
  const int16 along_z = (az >= ax) & (az >= ay), along_y = ay >= ax;
  const float16 inverse_z = along_z ? iz : along_y ? iy : ix;
  STORE_FLOATS(r->inverse_z + first, inverse_z);
  STORE_FLOATS(r->shear_x + first, -((along_z ? x : along_y ? z : y) * inverse_z));
  STORE_FLOATS(r->shear_y + first, -((along_z ? y : along_y ? x : z) * inverse_z));
  STORE_FLOATS(r->limit_z + first, max_distance * (along_z ? az : along_y ? ay : ax));
  const uint16 row1 = (uint16)(BVH_LEAF_WIDTH), row2 = (uint16)(2u * BVH_LEAF_WIDTH);
  STORE_UINTS(r->row_z + first, along_z ? row2 : along_y ? row1 : none);
  STORE_UINTS(r->row_x + first, along_z ? none : along_y ? row2 : row1);
  STORE_UINTS(r->row_y + first, along_z ? row1 : along_y ? none : row2);
  STORE_FLOATS(r->row_oz + first, along_z ? oz : along_y ? oy : ox);
  STORE_FLOATS(r->row_ox + first, along_z ? ox : along_y ? oz : oy);
  STORE_FLOATS(r->row_oy + first, along_z ? oy : along_y ? ox : oz);
}

void prepare_stream(StreamRays* r, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  for (uint first = 0; first < 32 && active >> first; first += 16) prepare_rays(r, origins, d, first, max_distance);
}

// enter_box() for all children of a node: entry distances, and lanes of -1 where ray k meets the child within [0, limit].
INLINE int16 enter_children(__global const BvhNode* node, const StreamRays* r, uint k, float limit, float16* entry) {
  __global const float* planes = &node->lo[0][0];
  const uint nx = r->near_x[k], ny = r->near_y[k], nz = r->near_z[k];
  const uint fx = HI_PLANES - nx, fy = HI_PLANES + 2u * BVH_WIDTH - ny, fz = HI_PLANES + 4u * BVH_WIDTH - nz;
  const float ox = r->ox[k], oy = r->oy[k], oz = r->oz[k];
  const float16 ax = (vload16(0, planes + nx) - ox) * r->ix[k];
  const float16 ay = (vload16(0, planes + ny) - oy) * r->iy[k];
  const float16 az = (vload16(0, planes + nz) - oz) * r->iz[k];
  const float16 bx = (vload16(0, planes + fx) - ox) * r->ix[k];
  const float16 by = (vload16(0, planes + fy) - oy) * r->iy[k];
  const float16 bz = (vload16(0, planes + fz) - oz) * r->iz[k];
  float16 enter = 0.0f, leave = limit;
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

INLINE void shear_leaf(ShearedLeaf* t, __global const TriangleLeaf* leaf, const StreamRays* r, uint k) {
  __global const float* x = &leaf->p[0][0][0] + r->row_x[k];
  __global const float* y = &leaf->p[0][0][0] + r->row_y[k];
  __global const float* z = &leaf->p[0][0][0] + r->row_z[k];
  const float ox = r->row_ox[k], oy = r->row_oy[k], oz = r->row_oz[k];
  const float sx = r->shear_x[k], sy = r->shear_y[k];
  const leaf_float az = LOAD_LEAF(z) - oz;
  const leaf_float bz = LOAD_LEAF(z + VERTEX_ROWS) - oz;
  const leaf_float cz = LOAD_LEAF(z + 2 * VERTEX_ROWS) - oz;
  const leaf_float ax = fma(sx, az, LOAD_LEAF(x) - ox), ay = fma(sy, az, LOAD_LEAF(y) - oy);
  const leaf_float bx = fma(sx, bz, LOAD_LEAF(x + VERTEX_ROWS) - ox), by = fma(sy, bz, LOAD_LEAF(y + VERTEX_ROWS) - oy);
  const leaf_float cx = fma(sx, cz, LOAD_LEAF(x + 2 * VERTEX_ROWS) - ox);
  const leaf_float cy = fma(sy, cz, LOAD_LEAF(y + 2 * VERTEX_ROWS) - oy);
  const leaf_float wa = cx * by - cy * bx, wb = ax * cy - ay * cx, wc = bx * ay - by * ax;
  t->wb = wb;
  t->wc = wc;
  t->det = wa + wb + wc;
  t->height = fma(wa, az, fma(wb, bz, wc * cz));
  const leaf_uint sign = AS_LEAF_UINT(t->det) & SIGN_BIT;
  t->inside = (AS_LEAF_FLOAT(AS_LEAF_UINT(wa) ^ sign) >= 0.0f) & (AS_LEAF_FLOAT(AS_LEAF_UINT(wb) ^ sign) >= 0.0f) &
              (AS_LEAF_FLOAT(AS_LEAF_UINT(wc) ^ sign) >= 0.0f);
}

// triangle_occludes() for all triangles of a leaf: -1 where ray k meets it, else 0.
INLINE leaf_int leaf_occludes(__global const TriangleLeaf* leaf, const StreamRays* r, uint k) {
  ShearedLeaf t;
  shear_leaf(&t, leaf, r, k);
  const leaf_uint flip = (AS_LEAF_UINT(t.det) ^ as_uint(r->inverse_z[k])) & SIGN_BIT;
  const leaf_float height = AS_LEAF_FLOAT(AS_LEAF_UINT(t.height) ^ flip);
  return t.inside & (height > 0.0f) & (height < fabs(t.det) * r->limit_z[k]);
}

// The any-hit traversal. What a node pushes is fetched into the cache at once, and one more entry is visited before the
// stack's new top: the memory is there when its turn comes.
uint stream_occluded(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  StreamRays rays;
  prepare_stream(&rays, origins, d, active, max_distance);
  uint stack_item[BVH_STACK_SIZE + BVH_WIDTH];  // a push writes whole vectors
  uint stack_rays[BVH_STACK_SIZE + BVH_WIDTH];
  uint size = 0;
  uint open = active;  // rays not yet occluded
  uint item = 0, rest = active;
  while (open) {
    uint next = 0, next_rays = 0;
    while (size > 0 && !next_rays) {
      next = stack_item[--size];
      next_rays = stack_rays[size] & open;
    }
    rest &= open;
    if (rest && (item & BVH_LEAF)) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      leaf_int met = 0;  // bit k of a lane: ray k meets that triangle
      do {
        const uint k = LOWEST_BIT(rest);
        rest &= rest - 1;
        met |= leaf_occludes(leaf, &rays, k) & (leaf_int)(int)(1u << k);
      } while (rest);
      open &= ~(uint)OR_LEAF_LANES(met);
    } else if (rest) {
      __global const BvhNode* node = &nodes[item];
      int16 met = 0;  // bit k of a lane: ray k meets that child
      do {
        const uint k = LOWEST_BIT(rest);
        rest &= rest - 1;
        float16 entry;
        met |= enter_children(node, &rays, k, max_distance, &entry) & (int16)(int)(1u << k);
      } while (rest);
      const uint lanes = NONZERO_LANES(met);
      APPEND_LANES(stack_item + size, vload16(0, node->child), lanes);
      APPEND_LANES(stack_rays + size, as_uint16(met), lanes);
      for (const uint end = size + popcount(lanes); size < end; ++size) PREFETCH_ITEM(stack_item[size])
    } else if (!next_rays) {
      break;
    }
    item = next;
    rest = next_rays;
  }
  return active & ~open;
}

// The nearest hits, front to back by the distance at which the first of the rays enters.
void stream_closest(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float* t,
                    uint* triangle, float* u, float* v) {
  StreamRays rays;
  prepare_stream(&rays, origins, d, active, INFINITY);
  for (uint rest = active; rest; rest &= rest - 1) triangle[LOWEST_BIT(rest)] = NO_TRIANGLE;
  const leaf_int leaf_bits = LEAF_BITS;
  uint stack_item[BVH_STACK_SIZE];
  uint stack_rays[BVH_STACK_SIZE];
  float stack_entry[BVH_STACK_SIZE];
  uint size = 1;
  stack_item[0] = 0;
  stack_rays[0] = active;
  stack_entry[0] = 0.0f;
  while (size > 0) {
    const uint item = stack_item[--size];
    const float least_entry = stack_entry[size];
    if (item & BVH_LEAF) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      for (uint rest = stack_rays[size]; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        if (least_entry > t[k] * FAR_PLANE_GROWTH) continue;
        ShearedLeaf f;
        shear_leaf(&f, leaf, &rays, k);
        const leaf_float distance = f.height * rays.inverse_z[k] / f.det;
        const leaf_int hit = f.inside & (distance > 0.0f) & (distance <= t[k]);
        uint lanes = (uint)OR_LEAF_LANES(hit & leaf_bits);
        if (!lanes) continue;
        float lane_distance[BVH_LEAF_WIDTH], lane_wb[BVH_LEAF_WIDTH], lane_wc[BVH_LEAF_WIDTH], lane_det[BVH_LEAF_WIDTH];
        STORE_LEAF(lane_distance, distance);
        STORE_LEAF(lane_wb, f.wb);
        STORE_LEAF(lane_wc, f.wc);
        STORE_LEAF(lane_det, f.det);
        for (; lanes; lanes &= lanes - 1) {
          const uint lane = LOWEST_BIT(lanes);
          const uint id = leaf->triangle[lane];
          // Of equally near triangles the lowest index, as closest_ray(); none at the limit itself.
          const bool nearer = lane_distance[lane] < t[k] ||
                              (lane_distance[lane] == t[k] && triangle[k] != NO_TRIANGLE && id < triangle[k]);
          if (!nearer) continue;
          t[k] = lane_distance[lane];
          triangle[k] = id;
          u[k] = lane_wb[lane] / lane_det[lane];
          v[k] = lane_wc[lane] / lane_det[lane];
        }
      }
    } else {
      __global const BvhNode* node = &nodes[item];
      int16 met = 0;
      float16 nearest = INFINITY;
      for (uint rest = stack_rays[size]; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        if (least_entry > t[k] * FAR_PLANE_GROWTH) continue;
        float16 entry;
        const int16 hit = enter_children(node, &rays, k, t[k], &entry);
        met |= hit & (int16)(int)(1u << k);
        entry = hit ? entry : (float16)(INFINITY);
        nearest = entry < nearest ? entry : nearest;
      }
      float lane_entry[BVH_WIDTH];
      uint lane_rays[BVH_WIDTH];
      STORE_FLOATS(lane_entry, nearest);
      STORE_UINTS(lane_rays, as_uint16(met));
      const uint first = size;
      for (uint lanes = NONZERO_LANES(met); lanes; lanes &= lanes - 1) {
        const uint lane = LOWEST_BIT(lanes);
        PREFETCH_ITEM(node->child[lane])
        uint place = size++;  // insertion keeps the nearest on top
        for (; place > first && stack_entry[place - 1] < lane_entry[lane]; --place) {
          stack_item[place] = stack_item[place - 1];
          stack_rays[place] = stack_rays[place - 1];
          stack_entry[place] = stack_entry[place - 1];
        }
        stack_item[place] = node->child[lane];
        stack_rays[place] = lane_rays[lane];
        stack_entry[place] = lane_entry[lane];
      }
    }
  }
}

#endif
