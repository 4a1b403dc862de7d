// Many rays go through the tree together. A node costs each ray that visits it one vector slab test for all children, a leaf one
// vector triangle test for all triangles.
#ifndef NOOK_TRAVERSE_STREAM_CL
#define NOOK_TRAVERSE_STREAM_CL

#include "trace/insertion.cl"
#include "trace/lane_lists.cl"
#include "trace/stream_tests.cl"
#include "trace/traverse_packet.cl"

#if !INSTANCES

// A tree of one node: its leaves, largest first, each tested by the rays that none before it has occluded.
INLINE uint occluded_by_root(BVH_PARAMS, const StreamRays* rays, const RayDirections* origins, const RayDirections* d, uint active,
                             float max_distance) {
  node_int met = 0;  // bit k of a lane: ray k meets that child
  for (uint rest = active; rest; rest &= rest - 1) {
    const uint k = LOWEST_BIT(rest);
    node_float entry;
    met |= enter_children(nodes, rays, k, max_distance, &entry) & (node_int)(int)(1u << k);
  }
  uint met_rays[BVH_WIDTH];
  STORE_NODE_UINTS(met_rays, AS_NODE_UINT(met));
  uint open = active;
  for (uint lane = BVH_COUNT(nodes->leaves); open && lane-- > 0;) {
    __global const TriangleLeaf* leaf = &leaves[BVH_FIRST(nodes->leaves) + lane];
    leaf_int hit = 0, unsure = 0;  // likewise, of a triangle
    for (uint rest = met_rays[lane] & open; rest; rest &= rest - 1) {
      const uint k = LOWEST_BIT(rest);
      leaf_int near;
      hit |= WITHOUT_HOLES(leaf, leaf_occludes(leaf, rays, k, &near), origins, d, k) & (leaf_int)(int)(1u << k);
      unsure |= near & (leaf_int)(int)(1u << k);
    }
    open &= ~(uint)OR_LEAF_LANES(hit);
    uint lanes[BVH_LEAF_WIDTH];
    uint near_rays = (uint)OR_LEAF_LANES(unsure) & open;
    if (!near_rays) continue;
    STORE_LEAF(lanes, AS_LEAF_UINT(unsure));
    for (; near_rays; near_rays &= near_rays - 1) {
      const uint k = LOWEST_BIT(near_rays);
      uint of_ray = 0;
      for (uint i = 0; i < BVH_LEAF_WIDTH; ++i) of_ray |= (lanes[i] >> k & 1u) << i;
      if (near_lanes_occlude(WITH_CUT_ARGS leaf, of_ray, origins, d, k, max_distance)) open &= ~(1u << k);
    }
  }
  return active & ~open;
}

// An append writes whole vectors; and stacks that begin a power of two apart would share the cache's sets.
#define RAY_STACK (BVH_STACK_SIZE + 2 * BVH_WIDTH)

// The any-hit traversal. Each ray has a stack of nodes of its own, and a round tests every open ray against its next node and then
// against the leaves that it met. The tests of a round need nothing of each other, and no branch and no address hangs on what one finds
// until all are done: so the processor works at many of them at once, and waits for many cache lines at once.
uint stream_occluded(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  StreamRays rays;
  prepare_stream(&rays, origins, d, active, max_distance);
  if (!BVH_COUNT(nodes->nodes)) return occluded_by_root(BVH_ARGS, &rays, origins, d, active, max_distance);
  uint stack[32 * RAY_STACK], size[32];
  for (uint k = 0; k < 32u; ++k) stack[k * RAY_STACK] = 0, size[k] = 1;
  uint ray[32], item[32];    // a round's tests of nodes
  KeptLanes kept[32];        // what they found
  uint met[33 * BVH_WIDTH];  // leaf << 5 | ray
  uint lanes_near[33 * BVH_WIDTH];
  uint open = active;        // rays not yet occluded
  for (uint waiting = active; waiting;) {
    uint count = 0;
    for (; waiting; waiting &= waiting - 1) {
      const uint k = LOWEST_BIT(waiting);
      ray[count] = k;
      item[count++] = stack[k * RAY_STACK + --size[k]];
    }
    for (uint i = 0; i < count; ++i) {
      node_float entry;
      KEEP_LANES(&kept[i], enter_children(&nodes[item[i]], &rays, ray[i], max_distance, &entry));
    }
    uint leaves_met = 0;
    for (uint i = 0; i < count; ++i) {
      const uint k = ray[i], lanes = KEPT_MASK(kept[i]);
      __global const BvhNode* node = &nodes[item[i]];
      const uint inner = BVH_COUNT(node->nodes), are_nodes = (1u << inner) - 1u;
      size[k] += append_lanes(stack + k * RAY_STACK + size[k], BVH_FIRST(node->nodes), 1u, lanes & are_nodes);
      waiting |= (uint)(size[k] != 0u) << k;
      leaves_met += append_lanes(met + leaves_met, (BVH_FIRST(node->leaves) - inner) << 5 | k, 32u, lanes & ~are_nodes);
    }
    for (uint i = 0; i < leaves_met; ++i) PREFETCH_ITEM(met[i] >> 5 | BVH_LEAF)
    uint leaves_near = 0;  // the first of `met` from then on: leaves with triangles that their ray is near, and which
    for (uint i = 0; i < leaves_met; ++i) {
      const uint k = met[i] & 31u;
      __global const TriangleLeaf* leaf = &leaves[met[i] >> 5];
      leaf_int near;
      const leaf_int hit = WITHOUT_HOLES(leaf, leaf_occludes(leaf, &rays, k, &near), origins, d, k);
      open &= ~((uint)(LEAF_MASK(hit) != 0u) << k);
      met[leaves_near] = met[i];
      lanes_near[leaves_near] = LEAF_MASK(near);
      leaves_near += lanes_near[leaves_near] != 0u;
    }
    for (uint i = 0; i < leaves_near; ++i) {
      const uint k = met[i] & 31u;
      __global const TriangleLeaf* leaf = &leaves[met[i] >> 5];
      if (!(open >> k & 1u)) continue;
      if (near_lanes_occlude(WITH_CUT_ARGS leaf, lanes_near[i], origins, d, k, max_distance)) open &= ~(1u << k);
    }
    waiting &= open;
  }
  return active & ~open;
}

#define MOVE_STREAM(to, from) stack_item[to] = stack_item[from]; stack_rays[to] = stack_rays[from];

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
      node_int met = 0;
      node_float nearest = INFINITY;
      for (uint rest = stack_rays[size]; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        if (least_entry > t[k] * FAR_PLANE_GROWTH) continue;
        node_float entry;
        const node_int hit = enter_children(node, &rays, k, t[k], &entry);
        met |= hit & (node_int)(int)(1u << k);
        entry = hit ? entry : (node_float)(INFINITY);
        nearest = entry < nearest ? entry : nearest;
      }
      float lane_entry[BVH_WIDTH];
      uint lane_rays[BVH_WIDTH];
      STORE_NODE_FLOATS(lane_entry, nearest);
      STORE_NODE_UINTS(lane_rays, AS_NODE_UINT(met));
      const uint first = size;
      for (uint lanes = NONZERO_CHILDREN(met); lanes; lanes &= lanes - 1) {
        const uint lane = LOWEST_BIT(lanes);
        const uint child = BVH_ITEM(node, lane);
        PREFETCH_ITEM(child)
        uint place = size++;
        INSERT_BY_ENTRY(place, first, stack_entry, lane_entry[lane], MOVE_STREAM)
        stack_item[place] = child;
        stack_rays[place] = lane_rays[lane];
      }
    }
  }
}

#endif

#endif
