// Whether rays have anything in reach (reach_tests.cl): what a few visits of the tree tell, for points by themselves and for those of a
// task together.
#ifndef NOOK_REACH_CL
#define NOOK_REACH_CL

#include "effect/reach_tests.cl"
#include "shared/task.h"

// Nodes and leaves looked at, at most. After that something is held to be in reach.
#define REACH_VISITS 12u

// Whether anything may be in reach; false only if nothing is.
#if INSTANCES

bool in_reach(__global const BvhNode* nodes, __global const TriangleLeaf* leaves, __global const PlacedMesh* instances, const Reach* r) {
  uint stack[BVH_STACK_SIZE + BVH_WIDTH], stack_instance[BVH_STACK_SIZE + BVH_WIDTH];
  uint size = 1;
  stack[0] = 0;
  stack_instance[0] = NO_INSTANCE;
  for (uint visits = 0; size > 0; ++visits) {
    if (visits == REACH_VISITS) return true;
    const uint item = stack[--size], instance = stack_instance[size];
    if ((item & BVH_LEAF) && instance != NO_INSTANCE) {
      PlacedLeaf leaf;
      open_leaf(&leaf, &leaves[item & ~BVH_LEAF], &instances[instance]);
      if (leaf_in_reach(&leaf, r)) return true;
      continue;
    }
    OpenedNode opened;
    open_node(&opened, nodes, leaves, instances, item, instance);
    bool inside;
    const uint lanes = children_in_reach(&opened, r, &inside);
    if (inside) return true;
    APPEND_LANES(stack + size, LOAD_NODE(opened.child), lanes);
    APPEND_LANES(stack_instance + size, LOAD_NODE(opened.instance), lanes);
    size += popcount(lanes);
  }
  return false;
}

#else

bool in_reach(__global const BvhNode* nodes, __global const TriangleLeaf* leaves, const Reach* r) {
  uint stack[BVH_STACK_SIZE + BVH_WIDTH];
  uint size = 1;
  stack[0] = 0;
  for (uint visits = 0; size > 0; ++visits) {
    if (visits == REACH_VISITS) return true;
    const uint item = stack[--size];
    if (item & BVH_LEAF) {
      if (leaf_in_reach(&leaves[item & ~BVH_LEAF], r)) return true;
      continue;
    }
    __global const BvhNode* node = &nodes[item];
    bool inside;
    const uint lanes = children_in_reach(node, r, &inside);
    if (inside) return true;
    size += append_children(stack + size, node, lanes);
  }
  return false;
}

#endif

// From this number of rays on a point is asked about by itself; below, the points of a task together.
#define ASKED_ALONE 16u

// A stream's points, by sample.
typedef struct {
  float nx[32], ny[32], nz[32];  // normals
  uint set[32];                  // ONLY_SELF: the group whose tree is asked
} AskedPoints;

// Of the samples `asked` with `count` rays each in the stream, all of one task: those of the `active` rays that need not be traced.
INLINE uint unreached_rays(__global const BvhNode* nodes, __global const TriangleLeaf* leaves AND_INSTANCE_PARAMS,
                           __global const uint* first_of_group,
                           const AskedPoints* points, uint asked, uint count, const RayDirections* origins, const RayDirections* d,
                           uint active, const EstimatorParams* p) {
  const uint j = LOWEST_BIT(asked), last = 31u - clz(asked);
  const uint end = (last + 1u) * count;
  const uint rays = active & (end == 32u ? 0xffffffffu : (1u << end) - 1u) & 0xffffffffu << j * count;
  if (!rays) return 0;
  Reach reach;
  reach_of(origins, d, rays, j == last, (float3)(points->nx[j], points->ny[j], points->nz[j]), MIN_DISTANCE ? p->min_distance : 0.0f,
           p->max_distance, &reach);
  if (!ONLY_SELF) return in_reach(nodes, leaves AND_INSTANCE_ARGS, &reach) ? 0u : rays;
  const uint set = points->set[j];
  for (uint rest = asked; rest; rest &= rest - 1)
    if (points->set[LOWEST_BIT(rest)] != set) return 0;
  return in_reach(nodes + first_of_group[2 * set], leaves + first_of_group[2 * set + 1] AND_INSTANCE_ARGS, &reach) ? 0u : rays;
}

#endif
