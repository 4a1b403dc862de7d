#include "bvh/triangle_leaf.hpp"

#include <algorithm>

namespace nook {
namespace {

// The largest side of the box about a lane's triangle.
float extent_of(const TriangleLeaf& leaf, unsigned lane) {
  float extent = 0;
  for (const auto& p : leaf.p) {
    const auto [least, most] =
        std::minmax({p[BVH_CORNER(0, lane)], p[BVH_CORNER(1, lane)], p[BVH_CORNER(2, lane)]});
    extent = std::max(extent, most - least);
  }
  return extent;
}

}  // namespace

TriangleLeaf empty_leaf() {
  TriangleLeaf leaf = {};
  std::fill_n(leaf.triangle, BVH_LEAF_WIDTH, BVH_EMPTY);
  return leaf;
}

TriangleLeaf triangle_leaf(const BinaryTree& tree, const TriangleMesh& mesh, std::uint32_t root) {
  const BinaryNode& node = tree.nodes[root];
  TriangleLeaf leaf = empty_leaf();
  for (unsigned i = 0; i < node.count; ++i) {
    const TrianglePair& pair = tree.pairs[node.first + i];
    leaf.triangle[i] = pair.first;
    leaf.triangle[i + BVH_LEAF_PAIRS] = pair.second;
    const auto& abc = mesh.triangles[pair.first];
    const std::uint32_t d = pair.second == BVH_EMPTY ? abc[2] : mesh.triangles[pair.second][1];
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 3; ++corner)
        leaf.p[axis][BVH_CORNER(corner, i)] = mesh.positions[abc[corner]][axis];
      leaf.p[axis][BVH_CORNER(1, i + BVH_LEAF_PAIRS)] = mesh.positions[d][axis];
    }
  }
  for (unsigned lane = 0; lane < BVH_LEAF_WIDTH; ++lane)
    leaf.near_height[lane] = NEAR_HEIGHT(extent_of(leaf, lane));
  return leaf;
}

}  // namespace nook
