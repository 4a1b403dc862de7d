// The lanes of a mask as a list, without a branch: by the processor's compress instruction, or from a table.
#ifndef NOOK_LANE_LISTS_CL
#define NOOK_LANE_LISTS_CL

#include "trace/stream_vector.cl"

#if !STREAM_AVX512
// Of a mask m of 8 lanes: its lanes, lowest first, as the bytes of a word (of a little-endian device, as CPU devices are):
//   sum over the set bits b of  b << 8 (number of set bits below b)
#define BIT(m, b) ((m) >> (b) & 1ul)
#define BITS_BELOW_3(m) (BIT(m, 0) + BIT(m, 1) + BIT(m, 2))
#define BITS_BELOW_5(m) (BITS_BELOW_3(m) + BIT(m, 3) + BIT(m, 4))
#define LANES_1_TO_3(m) \
  (BIT(m, 1) << 8 * BIT(m, 0) | BIT(m, 2) * 2 << 8 * (BIT(m, 0) + BIT(m, 1)) | BIT(m, 3) * 3 << 8 * BITS_BELOW_3(m))
#define LANES_4_TO_7(m)                                                                                  \
  (BIT(m, 4) * 4 << 8 * (BITS_BELOW_3(m) + BIT(m, 3)) | BIT(m, 5) * 5 << 8 * BITS_BELOW_5(m) |          \
   BIT(m, 6) * 6 << 8 * (BITS_BELOW_5(m) + BIT(m, 5)) | BIT(m, 7) * 7 << 8 * (BITS_BELOW_5(m) + BIT(m, 5) + BIT(m, 6)))
#define LIST(m) (LANES_1_TO_3(m) | LANES_4_TO_7(m))
#define LISTS_4(m) LIST(m), LIST(m + 1ul), LIST(m + 2ul), LIST(m + 3ul)
#define LISTS_16(m) LISTS_4(m), LISTS_4(m + 4ul), LISTS_4(m + 8ul), LISTS_4(m + 12ul)
#define LISTS_64(m) LISTS_16(m), LISTS_16(m + 16ul), LISTS_16(m + 32ul), LISTS_16(m + 48ul)
__constant ulong LANE_LISTS[256] = {LISTS_64(0ul), LISTS_64(64ul), LISTS_64(128ul), LISTS_64(192ul)};
#endif

// Appends first + step * lane for each of a node's lanes that is set, lowest first; returns how many. Up to BVH_WIDTH words behind them
// are overwritten.
INLINE uint append_lanes(uint* to, uint first, uint step, uint lanes) {
#if STREAM_AVX512
  APPEND_LANES(to, first + step * NODE_LANES, lanes);
#elif BVH_WIDTH == 8
  STORE_UINTS8(to, first + step * convert_uint8(as_uchar8(LANE_LISTS[lanes])));
#else
  const uint low = lanes & 255u, high = lanes >> 8;
  STORE_UINTS8(to, first + step * convert_uint8(as_uchar8(LANE_LISTS[low])));
  STORE_UINTS8(to + popcount(low), first + step * 8u + step * convert_uint8(as_uchar8(LANE_LISTS[high])));
#endif
  return popcount(lanes);
}

// The items of some of a node's children; up to BVH_WIDTH words behind them are overwritten.
INLINE uint append_children(uint* to, __global const BvhNode* node, uint lanes) {
  const uint nodes = BVH_COUNT(node->nodes), all_nodes = (1u << nodes) - 1u;
  const uint count = append_lanes(to, BVH_FIRST(node->nodes), 1u, lanes & all_nodes);
  return count + append_lanes(to + count, (BVH_LEAF | BVH_FIRST(node->leaves)) - nodes, 1u, lanes & ~all_nodes);
}

// BVH_ITEM of each lane; of the lanes without a child any value.
INLINE node_uint child_items(__global const BvhNode* node) {
  const uint nodes = BVH_COUNT(node->nodes);
  return NODE_LANES + (NODE_LANES < nodes ? (node_uint)(BVH_FIRST(node->nodes))
                                          : (node_uint)((BVH_LEAF | BVH_FIRST(node->leaves)) - nodes));
}

#endif
