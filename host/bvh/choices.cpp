#include "bvh/choices.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace nook {
namespace {

constexpr std::uint32_t task_size = 8192;  // pairs of a subtree that is a task of its own

}  // namespace

Choices::Choices(const BinaryTree& tree, unsigned width, TaskPool& pool) : tree_(tree), width_(width) {
  if (tree.pairs.size() < 2) return;
  choices_.resize(tree.pairs.size() - 1);
  std::vector<Subtree> subtrees;
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    if (tree.nodes[node].count <= task_size) {
      subtrees.push_back({node, {}});
    } else {
      open.push_back(tree.right(node));
      open.push_back(BinaryTree::left(node));
    }
  }
  pool.for_ranges(subtrees.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) subtrees[i].costs = choose(subtrees[i].node);
  });
  const Subtree* next = subtrees.data();
  choose_above(0, next);
}

Choices::Costs Choices::choose(std::uint32_t node) {
  const BinaryNode& n = tree_.nodes[node];
  if (n.is_leaf()) {
    Costs costs;
    costs.fill(n.half_area() * bvh_leaf_cost);
    return costs;
  }
  const Costs left = choose(BinaryTree::left(node));
  return combine(node, left, choose(tree_.right(node)));
}

// Above the tasks' subtrees, which come in the order of the leaves.
Choices::Costs Choices::choose_above(std::uint32_t node, const Subtree*& next) {
  if (tree_.nodes[node].count <= task_size) return (next++)->costs;
  const Costs left = choose_above(BinaryTree::left(node), next);
  return combine(node, left, choose_above(tree_.right(node), next));
}

Choices::Costs Choices::combine(std::uint32_t index, const Costs& l, const Costs& r) {
  const BinaryNode& node = tree_.nodes[index];
  Choice& choice = choices_[tree_.inner_number(index)];
  const unsigned most_left = std::min(width_, node.left_count),
                 most_right = std::min(width_, node.count - node.left_count),
                 most = std::min(width_, most_left + most_right);  // more roots than pairs are no use
  Costs costs;
  choice.left.fill(0);
  for (unsigned k = 2; k <= most; ++k) {
    float best = std::numeric_limits<float>::infinity();
    unsigned best_left = 0;
    for (unsigned i = k > most_right ? k - most_right : 1; i < k && i <= most_left; ++i) {
      const float cost = l[i - 1] + r[k - i - 1];
      if (cost < best || best_left == 0) {
        best = cost;
        best_left = i;
      }
    }
    if (k > 2 && costs[k - 2] <= best) {
      best = costs[k - 2];
      best_left = 0;
    }
    costs[k - 1] = best;
    choice.left[k - 1] = std::uint8_t(best_left);
  }
  std::fill(costs.begin() + most, costs.end(), costs[most - 1]);
  unsigned open = most;
  while (choice.left[open - 1] == 0) --open;
  choice.open_left = choice.left[open - 1];
  choice.open_right = std::uint8_t(open - choice.open_left);
  const float area = node.half_area();
  const float as_node = area * bvh_node_cost + costs[most - 1];
  const float as_leaf =
      node.count <= BVH_LEAF_PAIRS ? area * bvh_leaf_cost : std::numeric_limits<float>::infinity();
  // Areas beyond the floats' range compare false: then a leaf, where it fits.
  choice.as_leaf = node.count <= BVH_LEAF_PAIRS && !(as_node < as_leaf);
  costs[0] = choice.as_leaf ? as_leaf : as_node;
  // One root may be cheaper than several.
  for (unsigned k = 2; k <= width_ && costs[k - 1] > costs[0]; ++k) {
    costs[k - 1] = costs[0];
    choice.left[k - 1] = 0;
  }
  return costs;
}

void Choices::gather(std::uint32_t node, unsigned k, Children& children) const {
  if (!tree_.nodes[node].is_leaf()) {
    const Choice& choice = choices_[tree_.inner_number(node)];
    while (k > 1 && choice.left[k - 1] == 0) --k;
    if (k > 1) {
      gather(BinaryTree::left(node), choice.left[k - 1], children);
      gather(tree_.right(node), k - choice.left[k - 1], children);
      return;
    }
  }
  children.roots[children.count++] = node;
}

Choices::Children Choices::children_of(std::uint32_t node) const {
  const Choice& choice = choices_[tree_.inner_number(node)];
  Children children;
  gather(BinaryTree::left(node), choice.open_left, children);
  gather(tree_.right(node), choice.open_right, children);
  return children;
}

}  // namespace nook
