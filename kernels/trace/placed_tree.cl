// Trees of placed meshes, as a traversal opens them: the boxes and triangles of a mesh's own tree, moved into the world. Rays stay
// where they are, so that a ray meets exactly the triangles that it would meet in a tree over copies of the meshes: a placed
// vertex has the bits of the copy's vertex, and a placed box holds all of them.
#ifndef NOOK_PLACED_TREE_CL
#define NOOK_PLACED_TREE_CL

#include "shared/bvh.h"
#include "shared/instance.h"
#include "trace/lane_lists.cl"
#include "trace/stream_rays.cl"

#if INSTANCES

#define NO_INSTANCE 0xffffffffu  // an item of the tree over the instances

float3 placed_point(__global const PlacedMesh* mesh, float3 p) {
  return (float3)(PLACED(mesh->point[0], p.x, p.y, p.z), PLACED(mesh->point[1], p.x, p.y, p.z),
                  PLACED(mesh->point[2], p.x, p.y, p.z));
}

// One coordinate of a box's lower (or, `upper`, its upper) corner after placing. Within the box each fma of PLACED is least at the
// corner that the signs of the row choose; all its vertices are placed by PLACED too, so none lies below. Then grown by an ulp or
// two, as the boxes of the tree are (bvh.h).
INLINE node_float placed_planes(__global const BvhNode* node, __global const float* row, bool upper) {
  __global const float* planes = &node->lo[0][0];
  const uint x = (row[0] < 0.0f) != upper ? HI_PLANES : 0u, y = (row[1] < 0.0f) != upper ? HI_PLANES : 0u,
             z = (row[2] < 0.0f) != upper ? HI_PLANES : 0u;
  const node_float bound = fma((node_float)(row[0]), LOAD_NODE(planes + x),
                            fma((node_float)(row[1]), LOAD_NODE(planes + BVH_WIDTH + y),
                                fma((node_float)(row[2]), LOAD_NODE(planes + 2u * BVH_WIDTH + z), (node_float)(row[3]))));
  const node_float growth = fma(fabs(bound), 0x1p-23f, (node_float)(0x1p-126f));
  return upper ? bound + growth : bound - growth;
}

INLINE void open_placed_node(OpenedNode* opened, __global const BvhNode* node, __global const PlacedMesh* mesh, uint instance) {
  // A slot without a child has infinite planes, and 0 times them would be NaN: those of x alone keep every ray out.
  const node_int empty = NODE_LANES >= BVH_CHILDREN(node);
  const node_float lo = placed_planes(node, mesh->point[0], false), hi = placed_planes(node, mesh->point[0], true);
  STORE_NODE_FLOATS(opened->lo[0], empty ? (node_float)(INFINITY) : lo);
  STORE_NODE_FLOATS(opened->hi[0], empty ? (node_float)(-INFINITY) : hi);
  for (uint axis = 1; axis < 3; ++axis) {
    STORE_NODE_FLOATS(opened->lo[axis], placed_planes(node, mesh->point[axis], false));
    STORE_NODE_FLOATS(opened->hi[axis], placed_planes(node, mesh->point[axis], true));
  }
  STORE_NODE_UINTS(opened->child, child_items(node));
  STORE_NODE_UINTS(opened->instance, (node_uint)(instance));
}

// A leaf of the tree over the instances: lane i holds the placed mesh triangle[i], point i is the lower corner of its box and point i + 8
// the upper. As a node, its children are the roots of the meshes' trees.
INLINE void open_instances(OpenedNode* opened, __global const TriangleLeaf* leaf, __global const PlacedMesh* instances) {
  for (uint axis = 0; axis < 3; ++axis)
    for (uint lane = 0; lane < BVH_WIDTH; ++lane) {
      const bool used = lane < BVH_LEAF_PAIRS && leaf->triangle[lane] != BVH_EMPTY;
      opened->lo[axis][lane] = used ? leaf->p[axis][lane] : INFINITY;
      opened->hi[axis][lane] = used ? leaf->p[axis][BVH_LEAF_WIDTH + lane] : -INFINITY;
    }
  for (uint lane = 0; lane < BVH_WIDTH; ++lane) {
    const bool used = lane < BVH_LEAF_PAIRS && leaf->triangle[lane] != BVH_EMPTY;
    opened->instance[lane] = used ? leaf->triangle[lane] : NO_INSTANCE;
    opened->child[lane] = used ? instances[leaf->triangle[lane]].root : BVH_EMPTY;
  }
}

// Anything but a leaf of triangles.
INLINE void open_node(OpenedNode* opened, __global const BvhNode* nodes, __global const TriangleLeaf* leaves,
                      __global const PlacedMesh* instances, uint item, uint instance) {
  if (instance != NO_INSTANCE) {
    open_placed_node(opened, &nodes[item], &instances[instance], instance);
  } else if (item & BVH_LEAF) {
    open_instances(opened, &leaves[item & ~BVH_LEAF], instances);
  } else {
    __global const BvhNode* node = &nodes[item];
    for (uint axis = 0; axis < 3; ++axis) {
      STORE_NODE_FLOATS(opened->lo[axis], LOAD_NODE(node->lo[axis]));
      STORE_NODE_FLOATS(opened->hi[axis], LOAD_NODE(node->hi[axis]));
    }
    STORE_NODE_UINTS(opened->child, child_items(node));
    STORE_NODE_UINTS(opened->instance, (node_uint)(NO_INSTANCE));
  }
}

// A leaf of triangles, with their numbers in the scene.
INLINE void open_leaf(PlacedLeaf* opened, __global const TriangleLeaf* leaf, __global const PlacedMesh* mesh) {
  const float16 x = vload16(0, leaf->p[0]), y = vload16(0, leaf->p[1]), z = vload16(0, leaf->p[2]);
  for (uint axis = 0; axis < 3; ++axis) {
    __global const float* row = mesh->point[axis];
    STORE_FLOATS(opened->p[axis],
                 fma((float16)(row[0]), x, fma((float16)(row[1]), y, fma((float16)(row[2]), z, (float16)(row[3])))));
  }
  leaf_float extent = 0.0f;
  for (uint axis = 0; axis < 3; ++axis) {
    const float16 points = vload16(0, opened->p[axis]);
    const leaf_float a = FIRST_CORNERS(points), b = SECOND_CORNERS(points), c = THIRD_CORNERS(points);
    const leaf_float below = a < b ? a : b, above = a > b ? a : b, size = (above > c ? above : c) - (below < c ? below : c);
    extent = size > extent ? size : extent;
  }
  STORE_LEAF(opened->near_height, NEAR_HEIGHT(extent));
  const uint to_scene = mesh->first_triangle - mesh->mesh_triangle;
  for (uint lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
    opened->stored[lane] = leaf->triangle[lane];
    opened->triangle[lane] = leaf->triangle[lane] == BVH_EMPTY ? BVH_EMPTY : leaf->triangle[lane] + to_scene;
  }
}

#endif

#endif
