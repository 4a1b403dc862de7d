// Masks of a node's lanes: as they are kept while rays are tested, and as lists.
#include "trace/traverse.cl"

#define ROOM 48u

// out[ROOM i]: the mask of comparison results that hold in the lanes of i, kept and read again; then how many words were appended, and
// the words, after `first` others that must stay.
__kernel void lanes_of_mask(uint first, uint step, uint before, __global uint* out) {
  const uint mask = get_global_id(0);
  KeptLanes kept;
  KEEP_LANES(&kept, ((node_int)(int)mask & NODE_BITS) != 0);
  uint list[ROOM];
  for (uint i = 0; i < ROOM; ++i) list[i] = 7u;
  const uint count = append_lanes(list + before, first, step, mask);
  out[ROOM * mask] = KEPT_MASK(kept);
  out[ROOM * mask + 1u] = count;
  for (uint i = 0; i < before + count; ++i) out[ROOM * mask + 2u + i] = list[i];
}
