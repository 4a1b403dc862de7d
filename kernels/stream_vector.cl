// What the stream traversal needs of vectors and OpenCL C lacks, in a portable form and, where the processor has
// them, by its instructions. TRAVERSAL_PORTABLE keeps the portable form.
#ifndef NOOK_STREAM_VECTOR_CL
#define NOOK_STREAM_VECTOR_CL

#include "config.h"
#include "inline.h"
#include "rays.cl"
#include "shared/bvh.h"

#if defined(__AVX512F__) && defined(__clang__) && !TRAVERSAL_PORTABLE
#define STREAM_AVX512 1
#else
#define STREAM_AVX512 0
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

int or_lanes(int16 v) { return or_8_lanes(v.lo | v.hi); }

#define OR_LEAF_LANES(v) or_8_lanes(v)

// Asks for a node or leaf that is visited later.
#if defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
#define PREFETCH_LINE(p, line) __builtin_prefetch((const void*)((size_t)(p) + 64u * (line)))
#define PREFETCH_ITEM(item)                                                                              \
  {                                                                                                      \
    if ((item) & BVH_LEAF) {                                                                             \
      __attribute__((opencl_unroll_hint)) for (uint line = 0; line < sizeof(leaves->p) / 64; ++line) \
          PREFETCH_LINE(&leaves[(item) & ~BVH_LEAF], line);                                              \
    } else {                                                                                             \
      __attribute__((opencl_unroll_hint)) for (uint line = 0; line < sizeof(BvhNode) / 64; ++line)      \
          PREFETCH_LINE(&nodes[item], line);                                                             \
    }                                                                                                    \
  }
#else
#define PREFETCH_ITEM(item) \
  {}
#endif

#define LANE_NUMBERS (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
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
#define STORE_FLOATS(to, value) ((UnalignedFloats*)(to))->v = (value)
#define STORE_UINTS(to, value) ((UnalignedUints*)(to))->v = (value)
#define STORE_UINTS8(to, value) ((UnalignedUints8*)(to))->v = (value)

#if STREAM_AVX512

#define LOWEST_BIT(mask) ((uint)__builtin_ctz(mask))
// Bit i: lane i is not 0.
#define NONZERO_LANES(v) ((uint)__builtin_ia32_cmpd512_mask((v), (int16)(0), 4, (ushort)0xffff))
// The lanes that a comparison holds for (-1; the others 0), to be made a mask later.
typedef ushort KeptLanes;
#define KEEP_LANES(to, v) *(to) = (ushort)NONZERO_LANES(v)
#define KEPT_MASK(lanes) ((uint)(lanes))
// The chosen lanes of a uint16, one after another; up to 16 words behind them are overwritten.
#define APPEND_LANES(to, v, lanes) \
  STORE_UINTS(to, as_uint16(__builtin_ia32_compresssi512_mask(as_int16(v), as_int16(v), (ushort)(lanes))))

#else

#define LOWEST_BIT(mask) lowest_bit(mask)

uint nonzero_lanes(int16 v) {
  return (uint)or_lanes((v != 0) & LANE_BITS);
}

void append_words(uint* to, uint16 v, uint lanes) {
  uint word[BVH_WIDTH];
  vstore16(v, 0, word);
  for (; lanes; lanes &= lanes - 1) *to++ = word[lowest_bit(lanes)];
}

#define NONZERO_LANES(v) nonzero_lanes(v)

typedef struct {
  ulong low, high;  // a byte a lane
} KeptLanes;
typedef struct __attribute__((packed)) {
  char16 v;
} UnalignedBytes;
#define KEEP_LANES(to, lanes) ((UnalignedBytes*)(to))->v = convert_char16(lanes)

// Of byte i its bit i; the product adds all of them up in the highest byte.
uint mask_of_bytes(ulong bytes) { return (uint)((bytes & 0x8040201008040201ul) * 0x0101010101010101ul >> 56); }

#define KEPT_MASK(lanes) (mask_of_bytes((lanes).low) | mask_of_bytes((lanes).high) << 8)
#define APPEND_LANES(to, v, lanes) append_words(to, v, lanes)

#endif

#endif
