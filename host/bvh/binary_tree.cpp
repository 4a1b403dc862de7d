#include "bvh/binary_tree.hpp"

#include <algorithm>
#include <array>
#include <thread>

namespace nook {
namespace {

/// A triangle while it is sorted into the tree.
struct Reference {
  vec3 lo;
  std::uint32_t triangle;
  vec3 hi;
  std::uint32_t unused;
  /// Twice the box's centre: the half cancels wherever it is compared.
  vec3 center() const { return lo + hi; }
};

float half_area(const Bounds3& b) {
  const vec3 e = b.hi - b.lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

constexpr int bin_count = 32;
constexpr std::uint32_t fork_at = 16384;  // references that are worth a thread of their own

struct Split {
  int axis = -1;
  int bin = 0;  // references in bins below go left
  float scale = 0, offset = 0;
  int bin_of(const vec3& center) const {
    return std::clamp(int((center[axis] - offset) * scale), 0, bin_count - 1);
  }
};

class Builder {
 public:
  Builder(std::span<Reference> references, std::span<BinaryNode> nodes, SplitRule rule)
      : references_(references), nodes_(nodes), rule_(rule) {}

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, unsigned threads) {
    BinaryNode& result = nodes_[node];
    const std::span<Reference> range = references_.subspan(first, count);
    Bounds3 centers;
    for (const Reference& r : range) {
      result.box.add(r.lo);
      result.box.add(r.hi);
      centers.add(r.center());
    }
    result.first = first;
    result.count = count;
    if (count == 1) return;
    const std::uint32_t left_count = partition(range, centers);
    result.left_count = left_count;
    const std::uint32_t left = BinaryTree::left(node), right = node + 2 * left_count;
    if (threads > 1 && count > fork_at) {
      const unsigned half = threads / 2;
      std::thread other([&] { build(right, first + left_count, count - left_count, half); });
      build(left, first, left_count, threads - half);
      other.join();
    } else {
      build(left, first, left_count, 1);
      build(right, first + left_count, count - left_count, 1);
    }
  }

 private:
  /// Reorders the range into a left and a right part, neither empty; returns the left part's size.
  std::uint32_t partition(std::span<Reference> range, const Bounds3& centers) const {
    if (rule_ == SplitRule::surface_area) {
      const Split split = best_split(range, centers);
      if (split.axis >= 0) {
        const auto middle = std::partition(range.begin(), range.end(), [&](const Reference& r) {
          return split.bin_of(r.center()) < split.bin;
        });
        const auto left = std::uint32_t(middle - range.begin());
        if (left > 0 && left < range.size()) return left;
      }
    }
    const vec3 extent = centers.hi - centers.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto middle = range.begin() + range.size() / 2;
    std::nth_element(range.begin(), middle, range.end(), [&](const Reference& a, const Reference& b) {
      const float ca = a.center()[axis], cb = b.center()[axis];
      return ca < cb || (ca == cb && a.triangle < b.triangle);
    });
    return std::uint32_t(range.size() / 2);
  }

  static Split best_split(std::span<const Reference> range, const Bounds3& centers) {
    struct Bin {
      Bounds3 box;
      std::uint32_t count = 0;
    };
    Split best;
    float best_cost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centers.hi[axis] - centers.lo[axis];
      Split split;
      split.axis = axis;
      split.offset = centers.lo[axis];
      split.scale = bin_count / extent;
      if (!(extent > 0) || !std::isfinite(split.scale)) continue;
      std::array<Bin, bin_count> bins;
      for (const Reference& r : range) {
        Bin& bin = bins[split.bin_of(r.center())];
        bin.box.add(r.lo);
        bin.box.add(r.hi);
        ++bin.count;
      }
      std::array<float, bin_count> left_cost;
      Bounds3 box;
      std::uint32_t count = 0;
      for (int i = 0; i < bin_count - 1; ++i) {
        box.add(bins[i].box);
        count += bins[i].count;
        left_cost[i + 1] = count ? half_area(box) * float(count) : 0.0f;
      }
      box = {};
      count = 0;
      for (int i = bin_count - 1; i > 0; --i) {
        box.add(bins[i].box);
        count += bins[i].count;
        if (count == 0 || count == range.size()) continue;
        const float cost = left_cost[i] + half_area(box) * float(count);
        if (cost < best_cost) {
          best_cost = cost;
          best = split;
          best.bin = i;
        }
      }
    }
    return best;
  }

  std::span<Reference> references_;
  std::span<BinaryNode> nodes_;
  SplitRule rule_;
};

}  // namespace

BinaryTree build_binary_tree(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                             SplitRule rule, unsigned threads) {
  BinaryTree tree;
  if (triangles.empty()) return tree;
  std::vector<Reference> references(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Bounds3 box;
    for (const std::uint32_t index : mesh.triangles[triangles[i]]) box.add(mesh.positions[index]);
    references[i] = {box.lo, triangles[i], box.hi, 0};
  }
  tree.nodes.resize(2 * triangles.size() - 1);
  Builder(references, tree.nodes, rule).build(0, 0, std::uint32_t(triangles.size()), threads);
  tree.triangles.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) tree.triangles[i] = references[i].triangle;
  return tree;
}

}  // namespace nook
