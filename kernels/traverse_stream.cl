// All rays of one origin go through the tree together; a stack entry is a node and the mask of the rays that meet its
// box. A node visit costs each of its rays one vector slab test for all children; a leaf visit computes what depends
// on the origin alone once for all of its rays.
#ifndef NOOK_TRAVERSE_STREAM_CL
#define NOOK_TRAVERSE_STREAM_CL

// What the slab test reads of a ray.
typedef struct {
  float x[32], y[32], z[32];   // 1/d
  uint near_x[32], near_y[32], near_z[32];  // offset in floats, within a BvhNode, of the planes the ray enters through
} RaySlabs;

#define SLAB_HI (3u * BVH_WIDTH)  // offset in floats of BvhNode.hi behind BvhNode.lo

void prepare_slabs(RaySlabs* r, const RayDirections* d, uint active) {
  for (uint rest = active; rest; rest &= rest - 1) {
    const uint k = lowest_bit(rest);
    r->x[k] = 1.0f / d->x[k];
    r->y[k] = 1.0f / d->y[k];
    r->z[k] = 1.0f / d->z[k];
    r->near_x[k] = signbit(r->x[k]) ? SLAB_HI : 0u;
    r->near_y[k] = BVH_WIDTH + (signbit(r->y[k]) ? SLAB_HI : 0u);
    r->near_z[k] = 2u * BVH_WIDTH + (signbit(r->z[k]) ? SLAB_HI : 0u);
  }
}

// enter_box() for all children of a node: lanes are -1 where ray k meets the child within [0, limit], else 0.
int16 enter_children(__global const BvhNode* node, float3 o, const RaySlabs* r, uint k, float limit) {
  __global const float* planes = &node->lo[0][0];
  const uint nx = r->near_x[k], ny = r->near_y[k], nz = r->near_z[k];
  const uint fx = SLAB_HI - nx, fy = SLAB_HI + 2u * BVH_WIDTH - ny, fz = SLAB_HI + 4u * BVH_WIDTH - nz;
  const float16 ax = (vload16(0, planes + nx) - o.x) * r->x[k];
  const float16 ay = (vload16(0, planes + ny) - o.y) * r->y[k];
  const float16 az = (vload16(0, planes + nz) - o.z) * r->z[k];
  const float16 bx = (vload16(0, planes + fx) - o.x) * r->x[k];
  const float16 by = (vload16(0, planes + fy) - o.y) * r->y[k];
  const float16 bz = (vload16(0, planes + fz) - o.z) * r->z[k];
  float16 enter = 0.0f, leave = limit;
  enter = ax > enter ? ax : enter;
  leave = bx < leave ? bx : leave;
  enter = ay > enter ? ay : enter;
  leave = by < leave ? by : leave;
  enter = az > enter ? az : enter;
  leave = bz < leave ? bz : leave;
  return enter <= leave * FAR_PLANE_GROWTH;
}

// OrientedTriangle for the lanes of a leaf, and what an any-hit query with one limit compares `approach` with.
typedef struct {
  float16 nax, nay, naz, nbx, nby, nbz, ncx, ncy, ncz, nx, ny, nz, least_approach;
} OrientedLeaf;

void orient_leaf(OrientedLeaf* f, __global const TriangleLeaf* leaf, float3 o, float inverse_limit) {
  __global const float* p = &leaf->p[0][0][0];
  const float16 ax = vload16(0, p) - o.x, ay = vload16(1, p) - o.y, az = vload16(2, p) - o.z;
  const float16 bx = vload16(3, p) - o.x, by = vload16(4, p) - o.y, bz = vload16(5, p) - o.z;
  const float16 cx = vload16(6, p) - o.x, cy = vload16(7, p) - o.y, cz = vload16(8, p) - o.z;
#define CROSS_FMA(out, ux, uy, uz, vx, vy, vz)   \
  const float16 out##x = fma(uy, vz, -(uz * vy)); \
  const float16 out##y = fma(uz, vx, -(ux * vz)); \
  const float16 out##z = fma(ux, vy, -(uy * vx))
#define EDGE_NORMAL(out, u, v) \
  CROSS_FMA(out, (u##x - v##x), (u##y - v##y), (u##z - v##z), (u##x + v##x), (u##y + v##y), (u##z + v##z))
  CROSS_FMA(n, (ax - cx), (ay - cy), (az - cz), (bx - ax), (by - ay), (bz - az));
  EDGE_NORMAL(na, b, c);
  EDGE_NORMAL(nb, c, a);
  EDGE_NORMAL(nc, a, b);
#undef EDGE_NORMAL
#undef CROSS_FMA
  const float16 height = fma(ax, nx, fma(ay, ny, az * nz));
  const float16 side = height < 0.0f ? (float16)(-1.0f) : (float16)(1.0f);
  f->nax = side * nax, f->nay = side * nay, f->naz = side * naz;
  f->nbx = side * nbx, f->nby = side * nby, f->nbz = side * nbz;
  f->ncx = side * ncx, f->ncy = side * ncy, f->ncz = side * ncz;
  f->nx = side * nx, f->ny = side * ny, f->nz = side * nz;
  const float16 above = side * height;
  f->least_approach = above > 0.0f ? above * inverse_limit : (float16)(INFINITY);
}

// triangle_occludes() for the lanes of a leaf: -1 where the ray along d meets the triangle, else 0.
int16 leaf_occludes(const OrientedLeaf* f, float dx, float dy, float dz) {
  const float16 wa = fma(dx, f->nax, fma(dy, f->nay, dz * f->naz));
  const float16 wb = fma(dx, f->nbx, fma(dy, f->nby, dz * f->nbz));
  const float16 wc = fma(dx, f->ncx, fma(dy, f->ncy, dz * f->ncz));
  const float16 approach = fma(dx, f->nx, fma(dy, f->ny, dz * f->nz));
  return (wa >= 0.0f) & (wb >= 0.0f) & (wc >= 0.0f) & (approach > f->least_approach);
}

int or_lanes(int16 v) {
  const int8 a = v.lo | v.hi;
  const int4 b = a.lo | a.hi;
  const int2 c = b.lo | b.hi;
  return c.x | c.y;
}

uint stream_occluded_from(BVH_PARAMS, float3 origin, const RayDirections* d, uint active, float max_distance) {
  RaySlabs slabs;
  prepare_slabs(&slabs, d, active);
  const float inverse_limit = 1.0f / max_distance;
  uint stack_item[BVH_STACK_SIZE];
  uint stack_rays[BVH_STACK_SIZE];
  uint size = 1;
  uint open = active;  // rays not yet occluded
  stack_item[0] = 0;
  stack_rays[0] = active;
  while (size > 0 && open) {
    const uint item = stack_item[--size];
    const uint rays = stack_rays[size] & open;
    if (!rays) continue;
    int16 met = 0;  // bit k of a lane: ray k meets that child or triangle
    if (item & BVH_LEAF) {
      OrientedLeaf leaf;
      orient_leaf(&leaf, &leaves[item & ~BVH_LEAF], origin, inverse_limit);
      for (uint rest = rays; rest; rest &= rest - 1) {
        const uint k = lowest_bit(rest);
        met |= leaf_occludes(&leaf, d->x[k], d->y[k], d->z[k]) & (int16)(int)(1u << k);
      }
      open &= ~(uint)or_lanes(met);
    } else {
      __global const BvhNode* node = &nodes[item];
      for (uint rest = rays; rest; rest &= rest - 1) {
        const uint k = lowest_bit(rest);
        met |= enter_children(node, origin, &slabs, k, max_distance) & (int16)(int)(1u << k);
      }
      uint lane_rays[BVH_WIDTH];
      vstore16(as_uint16(met), 0, lane_rays);
      for (uint lane = 0; lane < BVH_WIDTH; ++lane) {
        if (!lane_rays[lane]) continue;
        stack_item[size] = node->child[lane];
        stack_rays[size++] = lane_rays[lane];
      }
    }
  }
  return active & ~open;
}

#endif
