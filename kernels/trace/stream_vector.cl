// What the stream traversal needs of vectors and OpenCL C lacks, in a portable form and, where the processor has
// them, by its instructions. TRAVERSAL_PORTABLE keeps the portable form.
#ifndef NOOK_STREAM_VECTOR_CL
#define NOOK_STREAM_VECTOR_CL

#include "config.h"
#include "inline.h"
#include "trace/prefetch.cl"
#include "trace/rays.cl"
#include "shared/bvh.h"

// With AVX-512 masks and lists of a node's lanes are instructions; with AVX masks are, where a node has 8.
#if defined(__AVX512F__) && (BVH_WIDTH == 16 || defined(__AVX512VL__)) && defined(__clang__) && !TRAVERSAL_PORTABLE
#define STREAM_AVX512 1
#else
#define STREAM_AVX512 0
#endif
#if defined(__AVX__) && BVH_WIDTH == 8 && defined(__clang__) && !TRAVERSAL_PORTABLE && !STREAM_AVX512
#define STREAM_AVX 1
#else
#define STREAM_AVX 0
#endif

// Vectors of a node's children.
#if BVH_WIDTH == 16
typedef float16 node_float;
typedef int16 node_int;
typedef uint16 node_uint;
#define LOAD_NODE(p) vload16(0, p)
#define AS_NODE_UINT as_uint16
#define NODE_LANES (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define NODE_BITS LANE_BITS
#define OR_NODE_LANES(v) or_lanes(v)
#else
typedef float8 node_float;
typedef int8 node_int;
typedef uint8 node_uint;
#define LOAD_NODE(p) vload8(0, p)
#define AS_NODE_UINT as_uint8
#define NODE_LANES (uint8)(0, 1, 2, 3, 4, 5, 6, 7)
#define NODE_BITS (int8)(1, 2, 4, 8, 16, 32, 64, 128)
#define OR_NODE_LANES(v) or_8_lanes(v)
#endif

// Vectors of a leaf's triangles.
typedef float8 leaf_float;
typedef int8 leaf_int;
typedef uint8 leaf_uint;
#define LOAD_LEAF(p) vload8(0, p)
#define STORE_LEAF(p, v) vstore8(v, 0, p)
#define AS_LEAF_FLOAT as_float8
#define AS_LEAF_UINT as_uint8
#define LEAF_BITS (leaf_int)(1, 2, 4, 8, 16, 32, 64, 128)
// Of 16 values, one a leaf's point, those of the triangles' corners: BVH_CORNER.
#define FIRST_CORNERS(points) (points).lo
#define SECOND_CORNERS(points) (points).hi
#define THIRD_CORNERS(points) (points).s45670123

int or_8_lanes(int8 a) {
  const int4 b = a.lo | a.hi;
  const int2 c = b.lo | b.hi;
  return c.x | c.y;
}

// LEAF_MASK: of the lanes of a leaf that a comparison holds for (-1; the others 0).
#if STREAM_AVX512 && defined(__AVX512VL__)
#define LEAF_MASK(v) ((uint)__builtin_ia32_cmpd256_mask((v), (int8)(0), 4, (uchar)0xff))
#elif defined(__AVX__) && defined(__clang__) && !TRAVERSAL_PORTABLE
#define LEAF_MASK(v) ((uint)__builtin_ia32_movmskps256(as_float8(v)))
#else
#define LEAF_MASK(v) ((uint)or_8_lanes((v) & LEAF_BITS))
#endif

int or_lanes(int16 v) { return or_8_lanes(v.lo | v.hi); }

#define OR_LEAF_LANES(v) or_8_lanes(v)

// Asks for all lines of a node or leaf that is visited later.
#if defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
#define PREFETCH_ITEM(item)                                                                              \
  {                                                                                                      \
    if ((item) & BVH_LEAF) {                                                                             \
      UNROLL for (uint line = 0; line < sizeof(TriangleLeaf) / 64; ++line)                               \
          PREFETCH_LINE(&leaves[(item) & ~BVH_LEAF], line);                                              \
    } else {                                                                                             \
      UNROLL for (uint line = 0; line < sizeof(BvhNode) / 64; ++line)                                    \
          PREFETCH_LINE(&nodes[item], line);                                                             \
    }                                                                                                    \
  }
#else
#define PREFETCH_ITEM(item) \
  {}
#endif

#define LANE_BITS (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768)

// PoCL makes three stores of a vstore16; a vector without alignment is one.
typedef struct __attribute__((packed)) {
  float16 v;
} UnalignedFloats;
typedef struct __attribute__((packed)) {
  uint16 v;
} UnalignedUints;
typedef struct __attribute__((packed)) {
  uint8 v;
} UnalignedUints8;
typedef struct __attribute__((packed)) {
  node_float v;
} UnalignedNodeFloats;
typedef struct __attribute__((packed)) {
  node_uint v;
} UnalignedNodeUints;
#define STORE_FLOATS(to, value) ((UnalignedFloats*)(to))->v = (value)
#define STORE_UINTS(to, value) ((UnalignedUints*)(to))->v = (value)
#define STORE_UINTS8(to, value) ((UnalignedUints8*)(to))->v = (value)
#define STORE_NODE_FLOATS(to, value) ((UnalignedNodeFloats*)(to))->v = (value)
#define STORE_NODE_UINTS(to, value) ((UnalignedNodeUints*)(to))->v = (value)

// Bit i of a mask: lane i of the vector is not 0. In NONZERO_LANES the lanes are 16 rays.
#if STREAM_AVX512
#define LOWEST_BIT(mask) ((uint)__builtin_ctz(mask))
#define NONZERO_LANES(v) ((uint)__builtin_ia32_cmpd512_mask((v), (int16)(0), 4, (ushort)0xffff))
#else
#define LOWEST_BIT(mask) lowest_bit(mask)
#define NONZERO_LANES(v) ((uint)or_lanes(((v) != 0) & LANE_BITS))
#endif

// NONZERO_CHILDREN: the same of a node's lanes.
// KEEP_LANES: the lanes of a node that a comparison holds for (-1; the others 0), to be made a mask later.
// APPEND_LANES: the chosen lanes of a node_uint, one after another; up to BVH_WIDTH words behind them are overwritten.
#if STREAM_AVX512 && BVH_WIDTH == 16
#define NONZERO_CHILDREN(v) NONZERO_LANES(v)
typedef ushort KeptLanes;
#define COMPRESSED(v, lanes) as_uint16(__builtin_ia32_compresssi512_mask(as_int16(v), as_int16(v), (ushort)(lanes)))
#elif STREAM_AVX512
#define NONZERO_CHILDREN(v) ((uint)__builtin_ia32_cmpd256_mask((v), (int8)(0), 4, (uchar)0xff))
typedef uchar KeptLanes;
#define COMPRESSED(v, lanes) as_uint8(__builtin_ia32_compresssi256_mask(as_int8(v), as_int8(v), (uchar)(lanes)))
#elif STREAM_AVX
#define NONZERO_CHILDREN(v) ((uint)__builtin_ia32_movmskps256(as_float8((v) != 0)))
typedef uchar KeptLanes;
#else
#define NONZERO_CHILDREN(v) ((uint)OR_NODE_LANES(((v) != 0) & NODE_BITS))
// Of byte i its bit i; the product adds all of them up in the highest byte.
uint mask_of_bytes(ulong bytes) { return (uint)((bytes & 0x8040201008040201ul) * 0x0101010101010101ul >> 56); }
#if BVH_WIDTH == 16
typedef struct {
  ulong low, high;  // a byte a lane
} KeptLanes;
typedef struct __attribute__((packed)) {
  char16 v;
} UnalignedBytes;
#define KEEP_LANES(to, lanes) ((UnalignedBytes*)(to))->v = convert_char16(lanes)
#define KEPT_MASK(lanes) (mask_of_bytes((lanes).low) | mask_of_bytes((lanes).high) << 8)
#else
typedef ulong KeptLanes;
#define KEEP_LANES(to, lanes) *(to) = as_ulong(convert_char8(lanes))
#define KEPT_MASK(lanes) mask_of_bytes(lanes)
#endif
#endif

#ifndef KEEP_LANES
#define KEEP_LANES(to, lanes) *(to) = (KeptLanes)NONZERO_CHILDREN(lanes)
#define KEPT_MASK(lanes) ((uint)(lanes))
#endif

#ifdef COMPRESSED
#define APPEND_LANES(to, v, lanes) STORE_NODE_UINTS(to, COMPRESSED(v, lanes))
#else
void append_words(uint* to, node_uint v, uint lanes) {
  uint word[BVH_WIDTH];
  STORE_NODE_UINTS(word, v);
  for (; lanes; lanes &= lanes - 1) *to++ = word[lowest_bit(lanes)];
}
#define APPEND_LANES(to, v, lanes) append_words(to, v, lanes)
#endif

#endif
