#include "bvh/collapse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nook {
namespace {

constexpr int width = BVH_WIDTH;

// What a ray pays for a visit: measured for streams (bench/README.md), in arbitrary units.
constexpr float node_cost = 1.0f;
constexpr float leaf_cost = 1.2f;

/// Costs of a subtree that is represented by at most k roots, k = 1 to width; each root is a leaf or a node.
struct Choice {
  std::array<float, width> cost;  ///< [k-1]
  std::array<std::uint8_t, width>
      left{};  ///< [k-1]: roots given to the left child; 0: the same as with k-1 roots
  std::uint8_t open_left = 0,
               open_right = 0;  ///< roots that the children get where this subtree's root is a node
  bool as_leaf = false;         ///< how one root is made
};

float half_area(const Bounds3& b) {
  const vec3 e = b.hi - b.lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

class Collapser {
 public:
  Collapser(const BinaryTree& tree, const TriangleMesh& mesh) : tree_(tree), mesh_(mesh) {}

  Bvh run() {
    bvh_.nodes.push_back(empty_node());
    if (!tree_.nodes.empty()) {
      choices_.resize(tree_.nodes.size());
      choose(0);
      fill(0, choices_[0].as_leaf ? std::vector<std::uint32_t>{0} : children_of(0), 1);
    }
    bvh_.statistics.triangles_per_leaf =
        bvh_.leaves.empty() ? 0.0 : double(tree_.triangles.size()) / double(bvh_.leaves.size());
    // A buffer cannot be empty: a leaf that no node refers to.
    if (bvh_.leaves.empty()) bvh_.leaves.push_back(empty_leaf());
    return std::move(bvh_);
  }

 private:
  static BvhNode empty_node() {
    BvhNode node;
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(node.lo[axis], width, std::numeric_limits<float>::infinity());
      std::fill_n(node.hi[axis], width, -std::numeric_limits<float>::infinity());
    }
    std::fill_n(node.child, width, BVH_EMPTY);
    return node;
  }

  static TriangleLeaf empty_leaf() {
    TriangleLeaf leaf = {};
    std::fill_n(leaf.triangle, BVH_LEAF_WIDTH, BVH_EMPTY);
    return leaf;
  }

  void choose(std::uint32_t index) {
    const BinaryNode& node = tree_.nodes[index];
    Choice& choice = choices_[index];
    const float area = half_area(node.box);
    if (node.is_leaf()) {
      choice.cost.fill(area * leaf_cost);
      choice.as_leaf = true;
      return;
    }
    choose(BinaryTree::left(index));
    choose(tree_.right(index));
    const Choice& l = choices_[BinaryTree::left(index)];
    const Choice& r = choices_[tree_.right(index)];
    for (int k = 2; k <= width; ++k) {
      float best = std::numeric_limits<float>::infinity();
      int best_left = 0;
      for (int i = 1; i < k; ++i) {
        const float cost = l.cost[i - 1] + r.cost[k - i - 1];
        if (cost < best) {
          best = cost;
          best_left = i;
        }
      }
      if (k > 2 && choice.cost[k - 2] <= best) {
        best = choice.cost[k - 2];
        best_left = 0;
      }
      choice.cost[k - 1] = best;
      choice.left[k - 1] = std::uint8_t(best_left);
    }
    int open = width;
    while (choice.left[open - 1] == 0) --open;
    choice.open_left = choice.left[open - 1];
    choice.open_right = std::uint8_t(open - choice.open_left);
    const float as_node = area * node_cost + choice.cost[width - 1];
    const float as_leaf =
        node.count <= BVH_LEAF_WIDTH ? area * leaf_cost : std::numeric_limits<float>::infinity();
    choice.as_leaf = as_leaf <= as_node;
    choice.cost[0] = std::min(as_leaf, as_node);
    // One root may be cheaper than several.
    for (int k = 2; k <= width && choice.cost[k - 1] > choice.cost[0]; ++k) {
      choice.cost[k - 1] = choice.cost[0];
      choice.left[k - 1] = 0;
    }
  }

  /// Appends the roots that represent the subtree best with at most k of them.
  void gather(std::uint32_t index, int k, std::vector<std::uint32_t>& roots) const {
    const Choice& choice = choices_[index];
    while (k > 1 && choice.left[k - 1] == 0) --k;
    if (k == 1) {
      roots.push_back(index);
      return;
    }
    gather(BinaryTree::left(index), choice.left[k - 1], roots);
    gather(tree_.right(index), k - choice.left[k - 1], roots);
  }

  /// The children of the wide node that stands for the subtree.
  std::vector<std::uint32_t> children_of(std::uint32_t index) const {
    std::vector<std::uint32_t> roots;
    gather(BinaryTree::left(index), choices_[index].open_left, roots);
    gather(tree_.right(index), choices_[index].open_right, roots);
    return roots;
  }

  std::uint32_t make_leaf(std::uint32_t index) {
    const BinaryNode& node = tree_.nodes[index];
    TriangleLeaf leaf = empty_leaf();
    for (std::uint32_t i = 0; i < node.count; ++i) {
      leaf.triangle[i] = tree_.triangles[node.first + i];
      for (int vertex = 0; vertex < 3; ++vertex)
        for (int axis = 0; axis < 3; ++axis)
          leaf.p[vertex][axis][i] = mesh_.positions[mesh_.triangles[leaf.triangle[i]][vertex]][axis];
    }
    bvh_.leaves.push_back(leaf);
    return std::uint32_t(bvh_.leaves.size() - 1) | BVH_LEAF;
  }

  /// Writes node `target` with the given children, then their subtrees depth first.
  void fill(std::uint32_t target, std::vector<std::uint32_t> children, unsigned depth) {
    bvh_.statistics.depth = std::max(bvh_.statistics.depth, depth);
    const auto area = [&](std::uint32_t c) { return half_area(tree_.nodes[c].box); };
    std::sort(children.begin(), children.end(), [&](std::uint32_t a, std::uint32_t b) {
      const bool leaf_a = choices_[a].as_leaf, leaf_b = choices_[b].as_leaf;
      if (leaf_a != leaf_b) return leaf_b;
      return area(a) < area(b) || (area(a) == area(b) && a < b);
    });
    const float root_area = half_area(tree_.nodes[0].box);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::uint32_t child = children[i];
      const Bounds3& box = tree_.nodes[child].box;
      for (int axis = 0; axis < 3; ++axis) {
        bvh_.nodes[target].lo[axis][i] =
            std::nextafter(box.lo[axis], -std::numeric_limits<float>::infinity());
        bvh_.nodes[target].hi[axis][i] = std::nextafter(box.hi[axis], std::numeric_limits<float>::infinity());
      }
      const bool as_leaf = choices_[child].as_leaf;
      if (root_area > 0)
        bvh_.statistics.sah_cost += (as_leaf ? leaf_cost : node_cost) * area(child) / root_area;
      if (as_leaf) {
        bvh_.nodes[target].child[i] = make_leaf(child);
      } else {
        bvh_.nodes[target].child[i] = std::uint32_t(bvh_.nodes.size());
        bvh_.nodes.push_back(empty_node());
      }
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (choices_[children[i]].as_leaf) continue;
      fill(bvh_.nodes[target].child[i], children_of(children[i]), depth + 1);
    }
  }

  const BinaryTree& tree_;
  const TriangleMesh& mesh_;
  std::vector<Choice> choices_;
  Bvh bvh_;
};

}  // namespace

Bvh collapse(const BinaryTree& tree, const TriangleMesh& mesh) {
  return Collapser(tree, mesh).run();
}

}  // namespace nook
