#include "bvh/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bvh/choices.hpp"
#include "bvh/triangle_leaf.hpp"

namespace nook {
namespace {

constexpr std::uint32_t task_size = 8192;  // pairs of a subtree that is a task of its own
constexpr float infinity = std::numeric_limits<float>::infinity();

template <unsigned Width>
BvhNode<Width> empty_node() {
  BvhNode<Width> node = {};
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(node.lo[axis], Width, infinity);
    std::fill_n(node.hi[axis], Width, -infinity);
  }
  return node;
}

/// Nodes and leaves: places in the arrays, or how many there are below a node.
struct Places {
  std::uint32_t nodes = 0, leaves = 0;
};

/// A wide node that is filled with all that is below it.
struct Job {
  std::uint32_t root;    // of the binary tree
  unsigned depth;        // of the wide node: 1 for the tree's root
  std::uint32_t target;  // the wide node's place
  Places next;           // where its descendants' places begin
};

template <unsigned Width>
class Collapser {
 public:
  Collapser(const BinaryTree& tree, const TriangleMesh& mesh, TaskPool& pool)
      : tree_(tree), mesh_(mesh), pool_(pool), choices_(tree, Width, pool) {}

  // The places are those of a traversal in depth: a node's children, then what is below each of them.
  // Descendants are counted before anything is written, so that tasks write side by side.
  Bvh run() {
    if (tree_.empty()) {
      // A buffer cannot be empty: a node without children, a leaf that no node refers to.
      nodes_.push_back(empty_node<Width>());
      bvh_.leaves.push_back(empty_leaf());
      return finished();
    }
    list_tasks(0);
    counts_.resize(tasks_.size());
    pool_.for_ranges(tasks_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) counts_[i] = below(tasks_[i]);
    });
    std::size_t task = 0;
    Places all = below_above(0, task);
    ++all.nodes;
    check_bvh_size(all.nodes, all.leaves);
    nodes_.resize(all.nodes);
    bvh_.leaves.resize(all.leaves);
    Places next = {1, 0};
    fill_above({0, 1, 0, {}}, next);
    std::vector<Bvh::Statistics> statistics(jobs_.size());
    pool_.for_ranges(jobs_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) fill(jobs_[i], jobs_[i].next, statistics[i]);
    });
    for (const Bvh::Statistics& s : statistics) {
      bvh_.statistics.depth = std::max(bvh_.statistics.depth, s.depth);
      bvh_.statistics.sah_cost += s.sah_cost;
    }
    bvh_.statistics.triangles_per_leaf = double(triangles()) / double(bvh_.leaves.size());
    return finished();
  }

 private:
  std::size_t triangles() const {
    std::size_t count = 0;
    for (const TrianglePair& pair : tree_.pairs) count += pair.second == BVH_EMPTY ? 1 : 2;
    return count;
  }

  Bvh finished() {
    bvh_.nodes = std::move(nodes_);
    return std::move(bvh_);
  }

  bool is_task(std::uint32_t root) const { return tree_.nodes[root].count <= task_size; }

  // A root that is one leaf is the only child of the wide root.
  Choices::Children children_of(std::uint32_t root) const {
    if (!choices_.is_leaf(root)) return choices_.children_of(root);
    Choices::Children only;
    only.roots[only.count++] = root;
    return only;
  }

  /// Appends the wide nodes' subtrees that are tasks, in depth-first order.
  void list_tasks(std::uint32_t root) {
    if (is_task(root)) {
      tasks_.push_back(root);
      return;
    }
    const Choices::Children children = sorted_children(root);
    for (std::uint32_t i = 0; i < children.count; ++i)
      if (!choices_.is_leaf(children.roots[i])) list_tasks(children.roots[i]);
  }

  /// What is below the wide node that stands for the subtree.
  Places below(std::uint32_t root) const {
    const Choices::Children children = children_of(root);
    Places sum;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      if (choices_.is_leaf(children.roots[i])) {
        ++sum.leaves;
        continue;
      }
      const Places more = below(children.roots[i]);
      sum.nodes += 1 + more.nodes;
      sum.leaves += more.leaves;
    }
    return sum;
  }

  Places below_above(std::uint32_t root, std::size_t& task) const {
    if (is_task(root)) return counts_[task++];
    const Choices::Children children = sorted_children(root);
    Places sum;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      if (choices_.is_leaf(children.roots[i])) {
        ++sum.leaves;
        continue;
      }
      const Places more = below_above(children.roots[i], task);
      sum.nodes += 1 + more.nodes;
      sum.leaves += more.leaves;
    }
    return sum;
  }

  Choices::Children sorted_children(std::uint32_t root) const {
    Choices::Children children = children_of(root);
    std::sort(children.roots.begin(), children.roots.begin() + children.count,
              [&](std::uint32_t a, std::uint32_t b) {
                const bool leaf_a = choices_.is_leaf(a), leaf_b = choices_.is_leaf(b);
                if (leaf_a != leaf_b) return leaf_b;
                const float area_a = tree_.nodes[a].half_area(), area_b = tree_.nodes[b].half_area();
                return area_a < area_b || (area_a == area_b && a < b);
              });
    return children;
  }

  /// Writes the job's node and the leaves among its children; returns the children that are nodes.
  std::vector<Job> fill_node(const Job& job, Places& next, Bvh::Statistics& statistics) {
    statistics.depth = std::max(statistics.depth, job.depth);
    const float root_area = tree_.nodes[0].half_area();
    const Choices::Children children = sorted_children(job.root);
    std::vector<Job> open;
    BvhNode<Width> made = empty_node<Width>();
    const Places first = next;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      const std::uint32_t child = children.roots[i];
      const BinaryNode& node = tree_.nodes[child];
      for (int axis = 0; axis < 3; ++axis) {
        made.lo[axis][i] = std::nextafter(node.lo[axis], -infinity);
        made.hi[axis][i] = std::nextafter(node.hi[axis], infinity);
      }
      const bool as_leaf = choices_.is_leaf(child);
      if (root_area > 0)
        statistics.sah_cost += (as_leaf ? bvh_leaf_cost : bvh_node_cost) * node.half_area() / root_area;
      if (as_leaf) {
        bvh_.leaves[next.leaves++] = triangle_leaf(tree_, mesh_, child);
      } else {
        open.push_back({child, job.depth + 1, next.nodes++, {}});
      }
    }
    made.nodes = BVH_RANGE(first.nodes, next.nodes - first.nodes);
    made.leaves = BVH_RANGE(first.leaves, next.leaves - first.leaves);
    nodes_[job.target] = made;
    return open;
  }

  void fill(const Job& job, Places& next, Bvh::Statistics& statistics) {
    for (const Job& open : fill_node(job, next, statistics)) fill(open, next, statistics);
  }

  void fill_above(const Job& job, Places& next) {
    if (is_task(job.root)) {
      const Places& count = counts_[jobs_.size()];
      jobs_.push_back({job.root, job.depth, job.target, next});
      next.nodes += count.nodes;
      next.leaves += count.leaves;
      return;
    }
    for (const Job& open : fill_node(job, next, bvh_.statistics)) fill_above(open, next);
  }

  const BinaryTree& tree_;
  const TriangleMesh& mesh_;
  TaskPool& pool_;
  Choices choices_;
  std::vector<std::uint32_t> tasks_;  // roots
  std::vector<Places> counts_;        // below each task's wide node
  std::vector<Job> jobs_;             // the same tasks, placed
  BvhNodes<Width> nodes_;
  Bvh bvh_;  // the rest of it
};

}  // namespace

Bvh collapse(const BinaryTree& tree, const TriangleMesh& mesh, unsigned width, TaskPool& pool) {
  return width == 8 ? Collapser<8>(tree, mesh, pool).run() : Collapser<16>(tree, mesh, pool).run();
}

}  // namespace nook
