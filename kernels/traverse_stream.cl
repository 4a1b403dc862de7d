// Many rays go through the tree together; a stack entry is a node and the mask of the rays that meet its box. A node
// visit costs each of its rays one vector slab test for all children, a leaf visit one vector triangle test for all
// triangles.
#ifndef NOOK_TRAVERSE_STREAM_CL
#define NOOK_TRAVERSE_STREAM_CL

#include "stream_tests.cl"
#include "traverse_packet.cl"

#if !INSTANCES

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
        const leaf_int of_ray = leaf_occludes(leaf, &rays, k);
        met |= WITHOUT_HOLES(leaf, of_ray, origins, d, k) & (leaf_int)(int)(1u << k);
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
void stream_closest(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, bool shared_origin, float* t,
                    uint* triangle, float* u, float* v) {
  StreamRays rays;
  prepare_stream(&rays, origins, d, active, INFINITY);
  for (uint rest = active; rest; rest &= rest - 1) triangle[LOWEST_BIT(rest)] = NO_TRIANGLE;
  Packet packet;
  if (shared_origin && active && make_packet(&rays, active, &packet)) {
    packet_closest(BVH_ARGS, &rays, &packet, active, t, triangle, u, v);
    return;
  }
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
        if (least_entry <= t[k] * FAR_PLANE_GROWTH) leaf_nearer(WITH_CUT_ARGS leaf, &rays, k, &t[k], &triangle[k], &u[k], &v[k]);
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

#endif
