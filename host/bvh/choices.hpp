#pragma once

#include <array>
#include <cstdint>

#include "bvh/binary_tree.hpp"
#include "kernels/shared/bvh.h"

namespace nook {

// What a ray pays for a visit: measured for streams (bench/journal.md), in arbitrary units.
constexpr float bvh_node_cost = 1.0f;
constexpr float bvh_leaf_cost = 1.2f;

/// The cheapest way to collapse a binary tree into wide nodes and leaves, by dynamic programming over "this
/// subtree as at most k roots", k = 1 to the nodes' width, where each root is a leaf or a node.
class Choices {
 public:
  static constexpr unsigned most_width = 16;

  Choices(const BinaryTree& tree, unsigned width, TaskPool& pool);

  /// Whether the subtree, as one root, is a leaf.
  bool is_leaf(std::uint32_t node) const {
    return tree_.nodes[node].is_leaf() || choices_[tree_.inner_number(node)].as_leaf;
  }

  struct Children {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::uint32_t count = 0;
    std::array<std::uint32_t, most_width> roots;  ///< of the binary tree
  };
  /// The children of the wide node that stands for the subtree, which is no leaf.
  Children children_of(std::uint32_t node) const;

 private:
  struct Choice {
    std::array<std::uint8_t, most_width>
        left;  // [k-1]: roots given to the left child; 0: the same as with k-1 roots
    std::uint8_t open_left, open_right;  // roots that the children get where this subtree's root is a node
    bool as_leaf;                        // how one root is made
  };
  // Costs of a subtree that is represented by at most k roots: [k-1].
  using Costs = std::array<float, most_width>;
  // A subtree that is a task of its own.
  struct Subtree {
    std::uint32_t node;
    Costs costs;
  };

  Costs choose(std::uint32_t node);
  Costs choose_above(std::uint32_t node, const Subtree*& next);
  Costs combine(std::uint32_t node, const Costs& left, const Costs& right);
  void gather(std::uint32_t node, unsigned k, Children& children) const;

  const BinaryTree& tree_;
  const unsigned width_;
  LargeVector<Choice> choices_;  // by BinaryTree::inner_number()
};

}  // namespace nook
