#include "bvh/binary_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bvh/binned_split.hpp"
#include "bvh/references.hpp"

namespace nook {
namespace {

constexpr std::uint32_t fork_at = 4096;       // references that are worth a task of their own
constexpr std::uint32_t share_at = 1u << 17;  // references that all threads split together
constexpr std::uint32_t sweep_at = 8;         // references that are split by trying every place
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A node to be made, and where its references are.
struct Range {
  std::uint32_t node, first, count;
  bool in_second = false;  // which of the two buffers
  Span4 span;
};

class Builder {
 public:
  Builder(References references, SplitRule rule, TaskPool& pool)
      : count_(references.values.size()), root_(references.span), rule_(rule), pool_(pool) {
    buffers_[0] = std::move(references.values);
    buffers_[1] = LargeVector<Reference>(count_);
    if (count_) tree_.nodes.resize(2 * count_ - 1);
    tree_.pairs.resize(count_);
  }

  BinaryTree run() {
    if (count_ == 0) return std::move(tree_);
    // Large nodes one after another, each by all threads; then subtrees, each by one.
    std::vector<Range> large = {{0, 0, std::uint32_t(count_), false, root_}}, rest;
    while (!large.empty()) {
      const Range range = large.back();
      large.pop_back();
      if (pool_.threads() == 1 || range.count < share_at) {
        rest.push_back(range);
        continue;
      }
      const auto [left, right] = divide(range, true);
      large.push_back(right);
      large.push_back(left);
    }
    for (const Range& range : rest) pool_.spawn([this, range] { build(range); });
    pool_.wait();
    return std::move(tree_);
  }

 private:
  Reference* at(const Range& range) { return buffers_[range.in_second].data() + range.first; }

  void build(Range range) {
    while (range.count > sweep_at) {
      auto [left, right] = divide(range, false);
      // The stack holds the smaller halves alone: it stays short however uneven the tree is.
      if (left.count < right.count) std::swap(left, right);
      if (right.count > fork_at)
        pool_.spawn([this, right = right] { build(right); });
      else
        build(right);
      range = left;
    }
    sweep(at(range), range.count, range.node, range.first);
  }

  /// Writes the range's node; its two children are left to be made.
  std::pair<Range, Range> divide(const Range& range, bool together) {
    Reference* from = at(range);
    Range left{range.node + 1, range.first, 0, range.in_second, {}}, right = left;
    Split split;
    if (rule_ == SplitRule::surface_area)
      split = together ? best_split(from, range.count, range.span, pool_)
                       : best_split(from, range.count, range.span);
    if (split.axis >= 0) {
      Reference* to = buffers_[!range.in_second].data() + range.first;
      const auto [l, r] =
          together ? partition(from, range.count, split, to, pool_) : partition(from, range.count, split, to);
      left.count = split.left_count;
      left.span = l;
      right.span = r;
      left.in_second = right.in_second = !range.in_second;
    } else {
      left.count = range.count / 2;
      halve(from, range.count, range.span);
      for (std::uint32_t i = 0; i < range.count; ++i) (i < left.count ? left : right).span.add(from[i]);
    }
    right.node = range.node + 2 * left.count;
    right.first = range.first + left.count;
    right.count = range.count - left.count;
    tree_.nodes[range.node] = {xyz(range.span.box.lo), xyz(range.span.box.hi), range.first, range.count,
                               left.count};
    return {left, right};
  }

  static void halve(Reference* references, std::uint32_t count, const Span4& span) {
    const Float4 extent = span.centers.hi - span.centers.lo;
    const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
    std::nth_element(references, references + count / 2, references + count,
                     [&](const Reference& a, const Reference& b) {
                       const float ca = a.lo[axis] + a.hi[axis], cb = b.lo[axis] + b.hi[axis];
                       return ca < cb || (ca == cb && a.first < b.first);
                     });
  }

  /// The subtree over a few references, by the best of all places along all axes.
  void sweep(Reference* references, std::uint32_t count, std::uint32_t node, std::uint32_t first) {
    Box4 box = Box4::empty();
    for (std::uint32_t i = 0; i < count; ++i) box.add(references[i].low(), references[i].high());
    BinaryNode& made = tree_.nodes[node];
    made = {xyz(box.lo), xyz(box.hi), first, count, count / 2};
    if (count == 1) {
      tree_.pairs[first] = {references[0].first, references[0].second};
      return;
    }
    if (count > 2) {
      std::array<Reference, sweep_at> held;  // NOLINT(cppcoreguidelines-pro-type-member-init)
      std::copy_n(references, count, held.begin());
      Order best_order{};
      float best = infinity;
      for (int axis = 0; axis < 3; ++axis) {
        const Order order = sorted(held.data(), count, axis);
        std::array<float, sweep_at> right_cost;  // NOLINT(cppcoreguidelines-pro-type-member-init)
        Box4 right = Box4::empty(), left = Box4::empty();
        for (std::uint32_t i = count - 1; i > 0; --i) {
          right.add(held[order[i]].low(), held[order[i]].high());
          right_cost[i] = right.half_area() * float(count - i);
        }
        bool better = axis == 0;
        for (std::uint32_t i = 1; i < count; ++i) {
          left.add(held[order[i - 1]].low(), held[order[i - 1]].high());
          const float cost = left.half_area() * float(i) + right_cost[i];
          if (!(cost < best)) continue;
          best = cost;
          made.left_count = i;
          better = true;
        }
        if (better) best_order = order;
      }
      for (std::uint32_t i = 0; i < count; ++i) references[i] = held[best_order[i]];
    }
    const std::uint32_t left = made.left_count;
    sweep(references, left, node + 1, first);
    sweep(references + left, count - left, node + 2 * left, first + left);
  }

  using Order = std::array<std::uint8_t, sweep_at>;

  /// By rising centre.
  static Order sorted(const Reference* references, std::uint32_t count, int axis) {
    Order order;
    std::array<float, sweep_at> centers;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    for (std::uint32_t i = 0; i < count; ++i) {
      const float center = references[i].lo[axis] + references[i].hi[axis];
      std::uint32_t j = i;
      for (; j > 0 && center < centers[j - 1]; --j) {
        centers[j] = centers[j - 1];
        order[j] = order[j - 1];
      }
      centers[j] = center;
      order[j] = std::uint8_t(i);
    }
    return order;
  }

  std::size_t count_;
  Span4 root_;
  SplitRule rule_;
  TaskPool& pool_;
  LargeVector<Reference> buffers_[2];
  BinaryTree tree_;
};

}  // namespace

BinaryTree build_binary_tree(const TriangleMesh& mesh, SplitRule rule, TaskPool& pool) {
  return Builder(make_references(mesh, pool), rule, pool).run();
}

}  // namespace nook
