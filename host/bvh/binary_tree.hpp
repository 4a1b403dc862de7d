#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/bounds.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A node of the binary tree that the wide tree is collapsed from. A subtree over n triangles occupies 2n-1
/// places of the node array from its root on: left child next, right child 2 * (left child's count) places
/// on. So the place of a node depends on its triangles alone, not on which thread got there first.
struct BinaryNode {
  Bounds3 box;
  std::uint32_t first = 0;  ///< of BinaryTree::triangles
  std::uint32_t count = 0;
  std::uint32_t left_count = 0;  ///< 0: a leaf, of one triangle

  bool is_leaf() const { return left_count == 0; }
};

struct BinaryTree {
  std::vector<BinaryNode> nodes;         ///< nodes[0] is the root; empty if there are no triangles
  std::vector<std::uint32_t> triangles;  ///< mesh triangles, in the order of the leaves

  static std::uint32_t left(std::uint32_t node) { return node + 1; }
  std::uint32_t right(std::uint32_t node) const { return node + 2 * nodes[node].left_count; }
};

/// How nodes are split.
enum class SplitRule {
  surface_area,  ///< binned surface area heuristic (Wald 2007)
  median         ///< object median along the longest axis: a balanced tree, whatever the mesh
};

/// Splits down to single triangles. `triangles` are indices into mesh.triangles. The result does not depend
/// on `threads` (at least 1).
BinaryTree build_binary_tree(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                             SplitRule rule, unsigned threads);

}  // namespace nook
