// Which surfaces an effect is about: receivers, where it is estimated, and groups that only occlude themselves. A set of occluders
// needs nothing here: it is a tree of its own.
#ifndef NOOK_SETS_CL
#define NOOK_SETS_CL

#include "config.h"
#include "effect/visibility.cl"

// A bit for each triangle of the mesh buffers. (A point of no triangle, a probe's, receives.)
bool receives(__global const uint* receivers, uint stored) { return receivers[stored >> 5] >> (stored & 31u) & 1u; }

// visible_rays() where ray k meets the triangles of group[k] alone: group g's tree starts at node first_of_group[2g] and leaf
// first_of_group[2g + 1]. The rays of one group go through its tree together.
uint visible_within_groups(BVH_PARAMS, __global const uint* first_of_group, const uint* group, RayDirections* origins,
                           const RayDirections* d, uint active, const EstimatorParams* p, float* visibility) {
  uint visible = 0;
  while (active) {
    const uint g = group[lowest_bit(active)];
    uint same = 0;
    for (uint rest = active; rest; rest &= rest - 1)
      if (group[lowest_bit(rest)] == g) same |= rest & (0u - rest);
    visible |= visible_rays(BVH_ARGS_AT(first_of_group[2 * g], first_of_group[2 * g + 1]), origins, d, same, p, visibility);
    active &= ~same;
  }
  return visible;
}

#endif
