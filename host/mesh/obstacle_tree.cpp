#include "mesh/obstacle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace nook {

void ObstacleTree::build(std::span<const dvec2> points, std::vector<std::uint32_t> chosen) {
  points_ = points;
  order_ = std::move(chosen);
  leaf_of_.assign(points.size(), nowhere);
  nodes_.clear();
  if (order_.empty()) return;
  nodes_.push_back(
      {dvec2(0), dvec2(0), 0, std::uint32_t(order_.size()), 0, nowhere, std::uint32_t(order_.size())});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

void ObstacleTree::split(std::uint32_t index) {
  Node& node = nodes_[index];
  node.lo = node.hi = points_[order_[node.begin]];
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    node.lo = glm::min(node.lo, points_[order_[i]]);
    node.hi = glm::max(node.hi, points_[order_[i]]);
  }
  if (node.end - node.begin <= leaf_points) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) leaf_of_[order_[i]] = index;
    return;
  }
  const int axis = node.hi.x - node.lo.x >= node.hi.y - node.lo.y ? 0 : 1;
  const std::uint32_t begin = node.begin, middle = begin + (node.end - begin) / 2, end = node.end;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
  node.child = std::uint32_t(nodes_.size());
  nodes_.push_back({dvec2(0), dvec2(0), begin, middle, 0, index, middle - begin});
  nodes_.push_back({dvec2(0), dvec2(0), middle, end, 0, index, end - middle});
}

void ObstacleTree::remove(std::uint32_t point) {
  if (nodes_.empty() || leaf_of_[point] == nowhere) return;
  for (std::uint32_t node = leaf_of_[point]; node != nowhere; node = nodes_[node].parent) --nodes_[node].left;
  leaf_of_[point] = nowhere;
}

// Never true of a node with a point in the triangle or on its border: the rounding of a side's equation is
// allowed for.
bool ObstacleTree::outside(const Node& node, const std::array<dvec2, 3>& triangle, const dvec2& lo,
                           const dvec2& hi) {
  if (node.lo.x > hi.x || node.hi.x < lo.x || node.lo.y > hi.y || node.hi.y < lo.y) return true;
  for (int k = 0; k < 3; ++k) {
    const dvec2 &a = triangle[std::size_t(k)], &b = triangle[std::size_t((k + 1) % 3)];
    // the corner of the box that is farthest to the side's left
    const dvec2 p(b.y >= a.y ? node.lo.x : node.hi.x, b.x >= a.x ? node.hi.y : node.lo.y);
    const double left = (b.x - a.x) * (p.y - a.y), right = (b.y - a.y) * (p.x - a.x);
    if (left - right < -1e-15 * (std::abs(left) + std::abs(right))) return true;
  }
  return false;
}

}  // namespace nook
