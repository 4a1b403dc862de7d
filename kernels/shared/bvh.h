// The bounding volume hierarchy as the kernels read it: wide nodes and leaves, both as structures of arrays, so that
// one vector instruction tests a ray against a whole node or leaf.
#ifndef NOOK_SHARED_BVH_H
#define NOOK_SHARED_BVH_H

#include "portable.h"
#ifdef __OPENCL_C_VERSION__
#include "config.h"
#include "shared/cut_out.h"
#include "shared/instance.h"
#endif

#define BVH_LEAF_PAIRS 4
#define BVH_LEAF_WIDTH 8       // triangles of a leaf: two a pair
#define BVH_LEAF 0x80000000u   // in an item that a traversal visits: the rest is an index into the leaves, not the nodes
#define BVH_EMPTY 0xffffffffu  // no item, no triangle
#define BVH_MAX_DEPTH 33       // levels of nodes that the builder may make: a balanced tree has no more, whatever its width

// A node of up to `width` children, which in kernels is BVH_WIDTH: seven cache lines with 16, four with 8. Read as:
//   for axis, lane: enter = ((d[axis] < 0 ? hi : lo)[axis][lane] - origin[axis]) / d[axis] ...
//   the lanes from 0 on are nodes: those of `nodes`; then come leaves: those of `leaves`
// The boxes contain their triangles strictly (grown by one ulp); a lane without a child has (+inf, -inf), which no ray meets.
// Nodes and leaves come by rising area: pushed in this order, a stack pops the largest first.
#define BVH_NODE_FIELDS(width)                     \
  float lo[3][width]; /* world units */            \
  float hi[3][width];                              \
  nook_uint nodes;  /* BVH_RANGE of Bvh::nodes */  \
  nook_uint leaves; /* BVH_RANGE of Bvh::leaves */ \
  nook_uint unused[14];
#ifdef __OPENCL_C_VERSION__
typedef struct {
  BVH_NODE_FIELDS(BVH_WIDTH)
} BvhNode;
#else
template <unsigned Width>
struct BvhNode {
  BVH_NODE_FIELDS(Width)
};
#endif

// Up to 16 neighbours in an array of up to 2^27: the first and how many.
#define BVH_RANGE(first, count) ((nook_uint)(first) | (nook_uint)(count) << 27)
#define BVH_FIRST(range) ((range) & 0x7ffffffu)
#define BVH_COUNT(range) ((range) >> 27)
// The children of a node, and what a traversal visits for one of them.
#define BVH_CHILDREN(node) (BVH_COUNT((node)->nodes) + BVH_COUNT((node)->leaves))
#define BVH_ITEM(node, lane)                                                        \
  ((lane) < BVH_COUNT((node)->nodes) ? BVH_FIRST((node)->nodes) + (lane)            \
                                     : BVH_LEAF | (BVH_FIRST((node)->leaves) + (lane) - BVH_COUNT((node)->nodes)))

// The largest side of the box about a triangle's corners a, b and c, an axis at a time; and the height, of those that triangle_occludes()
// computes, up to which it is too uncertain to tell on which side of the triangle a ray's origin lies: three half ulps of the products
// that it is a sum of. In 80 million tests of triangles of any shape it was off by 1.5 of them at most.
#define NEAR_HEIGHT(extent) (1.7881393e-7f * (extent) * (extent) * (extent))

// Pairs of triangles that share the edge between their last corner and their first, (a, b, c) and (c, d, a): four points instead of six,
// three cache lines of them. A fourth has the triangles' numbers and NEAR_HEIGHT of their extents. Read as:
//   points i, i + 4, i + 8, i + 12 are a, c, b, d of pair i
//   for lane: intersect the triangle of the points BVH_CORNER(0, 1 and 2, lane), which is mesh triangle[lane]
// Lanes i and i + 4 are a pair's first and second triangle. One without a partner has d = c; a lane without a triangle has no area,
// so that no ray meets it, and triangle BVH_EMPTY.
typedef struct {
  float p[3][2 * BVH_LEAF_WIDTH];  // [axis][point], world units
  nook_uint triangle[BVH_LEAF_WIDTH];
  float near_height[BVH_LEAF_WIDTH];
} TriangleLeaf;
#define BVH_CORNER(corner, lane) \
  ((corner) == 0 ? (lane) : (corner) == 1 ? (lane) + BVH_LEAF_WIDTH : (lane) ^ BVH_LEAF_PAIRS)

#ifdef __OPENCL_C_VERSION__
// A popped node pushes BVH_WIDTH children at most, so each level keeps BVH_WIDTH - 1 entries waiting. With INSTANCES a mesh's tree
// stands on a leaf of the tree over the instances, which pushes BVH_LEAF_PAIRS of them.
#if INSTANCES
#define BVH_STACK_SIZE (2 * BVH_MAX_DEPTH * (BVH_WIDTH - 1) + BVH_LEAF_PAIRS)
#else
#define BVH_STACK_SIZE (BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1)
#endif

// What a kernel passes through to the traversal: its buffers are Bvh::nodes and Bvh::leaves, in this order, with CUT_OUTS
// those of CutOuts, and with INSTANCES Bvh::instances. BVH_ARGS_AT: of several trees in one pair of buffers, the one that starts
// there.
#if CUT_OUTS
#define WITH_CUT_PARAMS CUT_PARAMS,
#define WITH_CUT_ARGS CUT_ARGS,
#define AND_CUT_PARAMS , CUT_PARAMS
#define AND_CUT_ARGS , CUT_ARGS
#else
#define WITH_CUT_PARAMS
#define WITH_CUT_ARGS
#define AND_CUT_PARAMS
#define AND_CUT_ARGS
#endif
#if INSTANCES
#define AND_INSTANCE_PARAMS , __global const PlacedMesh *instances
#define AND_INSTANCE_ARGS , instances
#define WITH_INSTANCE_PARAMS __global const PlacedMesh *instances,
#define WITH_INSTANCE_ARGS instances,
#else
#define AND_INSTANCE_PARAMS
#define AND_INSTANCE_ARGS
#define WITH_INSTANCE_PARAMS
#define WITH_INSTANCE_ARGS
#endif
#define BVH_PARAMS __global const BvhNode *nodes, __global const TriangleLeaf *leaves AND_CUT_PARAMS AND_INSTANCE_PARAMS
#define BVH_ARGS_AT(node, leaf) nodes + (node), leaves + (leaf)AND_CUT_ARGS AND_INSTANCE_ARGS
#define BVH_ARGS nodes, leaves AND_CUT_ARGS AND_INSTANCE_ARGS

// Nodes and leaves as the tests of rays take them: with INSTANCES a traversal moves them into the world first.
#if INSTANCES
typedef struct {
  float lo[3][BVH_WIDTH];     // as in BvhNode
  float hi[3][BVH_WIDTH];
  uint child[BVH_WIDTH];      // BVH_ITEM; any value where no ray meets the box
  uint instance[BVH_WIDTH];   // the placed mesh that the child is in
} OpenedNode;
typedef struct {
  float p[3][2 * BVH_LEAF_WIDTH];        // as in TriangleLeaf
  nook_uint triangle[BVH_LEAF_WIDTH];    // the number in the scene
  nook_uint stored[BVH_LEAF_WIDTH];      // in the mesh buffers
  float near_height[BVH_LEAF_WIDTH];     // of the placed triangle
} PlacedLeaf;
#define TREE_SPACE __private
#define TREE_NODE TREE_SPACE const OpenedNode
#define TREE_LEAF TREE_SPACE const PlacedLeaf
#define STORED_TRIANGLE(leaf, lane) (leaf)->stored[lane]
#else
#define TREE_SPACE __global
#define TREE_NODE TREE_SPACE const BvhNode
#define TREE_LEAF TREE_SPACE const TriangleLeaf
#define STORED_TRIANGLE(leaf, lane) (leaf)->triangle[lane]
#endif
#define TREE_FLOATS TREE_SPACE const float
#endif

#endif
