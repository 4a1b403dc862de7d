#pragma once

#include <cstdint>

#include "base/large_vector.hpp"
#include "base/task_pool.hpp"
#include "bvh/triangle_pairs.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A node of the binary tree that the wide tree is collapsed from. A subtree over n pairs of triangles
/// occupies 2n-1 places of the node array from its root on: left child next, right child 2 * (left child's
/// count) places on. So the place of a node depends on its pairs alone, not on which thread got there first.
struct BinaryNode {
  vec3 lo, hi;          ///< the box
  std::uint32_t first;  ///< of BinaryTree::pairs
  std::uint32_t count;
  std::uint32_t left_count;  ///< 0: a leaf, of one pair

  bool is_leaf() const { return left_count == 0; }
  float half_area() const {
    const vec3 e = hi - lo;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

struct BinaryTree {
  LargeVector<BinaryNode> nodes;    ///< 2 * pairs.size() - 1; nodes[0] is the root
  LargeVector<TrianglePair> pairs;  ///< in the order of the leaves

  bool empty() const { return pairs.empty(); }
  static std::uint32_t left(std::uint32_t node) { return node + 1; }
  std::uint32_t right(std::uint32_t node) const { return node + 2 * nodes[node].left_count; }
  /// Inner nodes have numbers of their own, without gaps: of the places before a node, as many are leaves as
  /// there are pairs before its own.
  std::uint32_t inner_number(std::uint32_t node) const { return node - nodes[node].first; }
};

/// How nodes are split.
enum class SplitRule {
  surface_area,  ///< surface area heuristic, binned (Wald 2007) but for a node's last eight pairs
  median         ///< object median along the longest axis: a balanced tree, whatever the mesh
};

/// Splits down to single pairs (pair_triangles()). The result does not depend on the pool's number of
/// threads.
BinaryTree build_binary_tree(const TriangleMesh& mesh, SplitRule rule, TaskPool& pool);

}  // namespace nook
