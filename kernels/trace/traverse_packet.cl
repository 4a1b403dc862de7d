// A packet's way through the tree, front to back by where its interval enters.
#ifndef NOOK_TRAVERSE_PACKET_CL
#define NOOK_TRAVERSE_PACKET_CL

#include "trace/insertion.cl"
#include "trace/packet_tests.cl"

#if !INSTANCES

// The greatest t of the rays.
INLINE float farthest(const float* t, uint rays) {
  float16 most = -INFINITY;
  for (uint first = 0; first < 32u && rays >> first; first += GROUP) {
    const float16 v = lanes_of(rays >> first) ? vload16(0, t + first) : most;
    most = v > most ? v : most;
  }
  return most_lane(most);
}

#define MOVE_PACKET(to, from) stack_item[to] = stack_item[from]; stack_rays[to] = stack_rays[from];

// The arrays are of 32; the entries that are not in `active` may be written.
void packet_closest(BVH_PARAMS, const StreamRays* r, const Packet* p, uint active, float* t, uint* triangle, float* u, float* v) {
  uint stack_item[BVH_STACK_SIZE];
  uint stack_rays[BVH_STACK_SIZE];
  float stack_entry[BVH_STACK_SIZE];
  uint size = 1;
  stack_item[0] = 0;
  stack_rays[0] = active;
  stack_entry[0] = 0.0f;
  float limit = farthest(t, active);
  while (size > 0) {
    const uint item = stack_item[--size];
    if (stack_entry[size] > limit * FAR_PLANE_GROWTH) continue;
    const uint rays = stack_rays[size];
    if (item & BVH_LEAF) {
      __global const TriangleLeaf* leaf = &leaves[item & ~BVH_LEAF];
      if (CUT_OUTS || popcount(rays) <= FEW_RAYS) {
        for (uint rest = rays; rest; rest &= rest - 1) {
          const uint k = LOWEST_BIT(rest);
          leaf_nearer(WITH_CUT_ARGS leaf, r, k, &t[k], &triangle[k], &u[k], &v[k]);
        }
        limit = farthest(t, active);
        continue;
      }
      LeafFromOrigin from;
      move_to_origin(&from, leaf, p);
      for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane)
        for (uint first = 0; leaf->triangle[lane] != NO_TRIANGLE && first < 32u && rays >> first; first += GROUP)
          if (rays >> first & GROUP_RAYS)
            meet_triangle(leaf, &from, lane, r, first, rays >> first & GROUP_RAYS, t, triangle, u, v);
      limit = farthest(t, active);
    } else {
      __global const BvhNode* node = &nodes[item];
      node_float entry;
      uint lanes = children_met(node, p, limit, &entry);
      float lane_entry[BVH_WIDTH];
      STORE_NODE_FLOATS(lane_entry, entry);
      const uint first = size;
      for (; lanes; lanes &= lanes - 1) {
        const uint lane = LOWEST_BIT(lanes);
        const uint met = rays_met(node, lane, r, p, rays, t);
        if (!met) continue;
        const uint child = BVH_ITEM(node, lane);
        PREFETCH_ITEM(child)
        uint place = size++;
        INSERT_BY_ENTRY(place, first, stack_entry, lane_entry[lane], MOVE_PACKET)
        stack_item[place] = child;
        stack_rays[place] = met;
      }
    }
  }
}

#endif

#endif
