// The stream traversal where meshes are placed many times: a stack entry has the placed mesh that its node or leaf is in, too. What is
// visited is moved into the world once for all its rays; then the tests are those of traverse_stream.cl.
#ifndef NOOK_TRAVERSE_INSTANCES_CL
#define NOOK_TRAVERSE_INSTANCES_CL

#include "trace/insertion.cl"
#include "trace/placed_tree.cl"
#include "trace/stream_tests.cl"

#if INSTANCES

uint stream_occluded(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, float max_distance) {
  StreamRays rays;
  prepare_stream(&rays, origins, d, active, max_distance);
  uint stack_item[BVH_STACK_SIZE + BVH_WIDTH];  // a push writes whole vectors
  uint stack_rays[BVH_STACK_SIZE + BVH_WIDTH];
  uint stack_instance[BVH_STACK_SIZE + BVH_WIDTH];
  uint size = 1;
  stack_item[0] = 0;
  stack_rays[0] = active;
  stack_instance[0] = NO_INSTANCE;
  uint open = active;  // rays not yet occluded
  while (size > 0 && open) {
    const uint item = stack_item[--size], instance = stack_instance[size];
    uint rest = stack_rays[size] & open;
    if (!rest) continue;
    if ((item & BVH_LEAF) && instance != NO_INSTANCE) {
      PlacedLeaf leaf;
      open_leaf(&leaf, &leaves[item & ~BVH_LEAF], &instances[instance]);
      leaf_int met = 0;  // bit k of a lane: ray k meets that triangle
      for (; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        leaf_int near;
        met |= WITHOUT_HOLES(&leaf, leaf_occludes(&leaf, &rays, k, &near), origins, d, k) & (leaf_int)(int)(1u << k);
        const uint lanes = (uint)OR_LEAF_LANES(near & LEAF_BITS);
        if (lanes && near_lanes_occlude(WITH_CUT_ARGS &leaf, lanes, origins, d, k, max_distance)) open &= ~(1u << k);
      }
      open &= ~(uint)OR_LEAF_LANES(met);
    } else {
      OpenedNode opened;
      open_node(&opened, nodes, leaves, instances, item, instance);
      node_int met = 0;  // bit k of a lane: ray k meets that child
      for (; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        node_float entry;
        met |= enter_children(&opened, &rays, k, max_distance, &entry) & (node_int)(int)(1u << k);
      }
      const uint lanes = NONZERO_CHILDREN(met);
      APPEND_LANES(stack_item + size, LOAD_NODE(opened.child), lanes);
      APPEND_LANES(stack_rays + size, AS_NODE_UINT(met), lanes);
      APPEND_LANES(stack_instance + size, LOAD_NODE(opened.instance), lanes);
      for (const uint end = size + popcount(lanes); size < end; ++size) PREFETCH_ITEM(stack_item[size])
    }
  }
  return active & ~open;
}

#define MOVE_PLACED_STREAM(to, from)  \
  stack_item[to] = stack_item[from];   \
  stack_rays[to] = stack_rays[from];   \
  stack_instance[to] = stack_instance[from];

// The nearest hits, front to back by the distance at which the first of the rays enters.
void stream_closest(BVH_PARAMS, const RayDirections* origins, const RayDirections* d, uint active, bool shared_origin, float* t,
                    uint* triangle, float* u, float* v) {
  StreamRays rays;
  (void)shared_origin;  // a packet goes through one tree
  prepare_stream(&rays, origins, d, active, INFINITY);
  for (uint rest = active; rest; rest &= rest - 1) triangle[LOWEST_BIT(rest)] = NO_TRIANGLE;
  uint stack_item[BVH_STACK_SIZE];
  uint stack_rays[BVH_STACK_SIZE];
  uint stack_instance[BVH_STACK_SIZE];
  float stack_entry[BVH_STACK_SIZE];
  uint size = 1;
  stack_item[0] = 0;
  stack_rays[0] = active;
  stack_instance[0] = NO_INSTANCE;
  stack_entry[0] = 0.0f;
  while (size > 0) {
    const uint item = stack_item[--size], instance = stack_instance[size];
    const float least_entry = stack_entry[size];
    uint waiting = 0;  // rays that may still find something nearer here
    for (uint rest = stack_rays[size]; rest; rest &= rest - 1) {
      const uint k = LOWEST_BIT(rest);
      if (least_entry <= t[k] * FAR_PLANE_GROWTH) waiting |= 1u << k;
    }
    if (!waiting) continue;
    if ((item & BVH_LEAF) && instance != NO_INSTANCE) {
      PlacedLeaf leaf;
      open_leaf(&leaf, &leaves[item & ~BVH_LEAF], &instances[instance]);
      for (uint rest = waiting; rest; rest &= rest - 1) {
        const uint k = LOWEST_BIT(rest);
        leaf_nearer(WITH_CUT_ARGS &leaf, &rays, k, &t[k], &triangle[k], &u[k], &v[k]);
      }
      continue;
    }
    OpenedNode opened;
    open_node(&opened, nodes, leaves, instances, item, instance);
    node_int met = 0;
    node_float nearest = INFINITY;
    for (uint rest = waiting; rest; rest &= rest - 1) {
      const uint k = LOWEST_BIT(rest);
      node_float entry;
      const node_int hit = enter_children(&opened, &rays, k, t[k], &entry);
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
      PREFETCH_ITEM(opened.child[lane])
      uint place = size++;
      INSERT_BY_ENTRY(place, first, stack_entry, lane_entry[lane], MOVE_PLACED_STREAM)
      stack_item[place] = opened.child[lane];
      stack_rays[place] = lane_rays[lane];
      stack_instance[place] = opened.instance[lane];
    }
  }
}

#endif

#endif
