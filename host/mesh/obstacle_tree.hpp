#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.hpp"

namespace nook {

/// Points of the plane that are looked up by triangles and taken out one by one: a k-d tree (Bentley 1975)
/// that knows how many points are left below each of its nodes.
class ObstacleTree {
 public:
  /// `chosen`: indices into `points`, each once.
  void build(std::span<const dvec2> points, std::vector<std::uint32_t> chosen);
  void remove(std::uint32_t point);

  /// Calls stop(point) for the points left in or near the triangle, counter-clockwise, until it answers true.
  template <class Stop>
  bool any(const std::array<dvec2, 3>& triangle, const Stop& stop) {
    if (nodes_.empty()) return false;
    const dvec2 lo = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const dvec2 hi = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    stack_.assign(1, 0);
    while (!stack_.empty()) {
      const Node& node = nodes_[stack_.back()];
      stack_.pop_back();
      if (node.left == 0 || outside(node, triangle, lo, hi)) continue;
      if (node.child != 0) {
        stack_.push_back(node.child);
        stack_.push_back(node.child + 1);
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const dvec2& p = points_[order_[i]];
        const bool in_box = p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y;
        if (in_box && leaf_of_[order_[i]] != nowhere && stop(order_[i])) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t nowhere = 0xffffffffu, leaf_points = 8;

  struct Node {
    dvec2 lo, hi;
    std::uint32_t begin, end;  // in order_
    std::uint32_t child;       // the first of two, or 0: a leaf
    std::uint32_t parent;
    std::uint32_t left;  // points not removed
  };

  void split(std::uint32_t node);
  static bool outside(const Node& node, const std::array<dvec2, 3>& triangle, const dvec2& lo,
                      const dvec2& hi);

  std::span<const dvec2> points_;
  std::vector<std::uint32_t> order_, leaf_of_, stack_;
  std::vector<Node> nodes_;
};

}  // namespace nook
