#include "mesh/outline_crossing.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/orientation.hpp"

namespace nook {
namespace {

struct Box2 {
  dvec2 lo, hi;
};

Box2 around(const Box2& a, const Box2& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

bool apart(const Box2& a, const Box2& b) {
  return a.lo.x > b.hi.x || b.lo.x > a.hi.x || a.lo.y > b.hi.y || b.lo.y > a.hi.y;
}

class Crossings {
 public:
  explicit Crossings(std::span<const dvec2> outline)
      : outline_(outline), tolerance_(outline_tolerance(outline)), work_(100 * outline.size() + 10000) {
    leaves_ = 1;
    while (leaves_ < outline.size()) leaves_ *= 2;
    boxes_.resize(2 * leaves_, Box2{dvec2(1), dvec2(-1)});
    for (std::size_t e = 0; e < outline.size(); ++e)
      boxes_[leaves_ + e] = {glm::min(outline[e], end_of(e)), glm::max(outline[e], end_of(e))};
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      boxes_[node] = empty(2 * node + 1) ? boxes_[2 * node] : around(boxes_[2 * node], boxes_[2 * node + 1]);
  }

  bool any() { return within(1); }

 private:
  const dvec2& end_of(std::size_t edge) const { return outline_[edge + 1 == outline_.size() ? 0 : edge + 1]; }
  bool empty(std::size_t node) const { return boxes_[node].lo.x > boxes_[node].hi.x; }

  bool within(std::size_t node) {
    if (node >= leaves_ || empty(node)) return false;
    return within(2 * node) || within(2 * node + 1) || between(2 * node, 2 * node + 1);
  }

  bool between(std::size_t a, std::size_t b) {
    if (empty(a) || empty(b) || apart(boxes_[a], boxes_[b]) || work_ == 0) return false;
    --work_;
    if (a >= leaves_) return cross(a - leaves_, b - leaves_);
    return between(2 * a, 2 * b) || between(2 * a, 2 * b + 1) || between(2 * a + 1, 2 * b) ||
           between(2 * a + 1, 2 * b + 1);
  }

  bool cross(std::size_t e, std::size_t f) const {  // e < f; neighbours cannot
    if (f == e + 1 || (e == 0 && f + 1 == outline_.size())) return false;
    const dvec2 &a = outline_[e], &b = end_of(e), &c = outline_[f], &d = end_of(f);
    if (orientation(a, b, c) * orientation(a, b, d) >= 0 || orientation(c, d, a) * orientation(c, d, b) >= 0)
      return false;
    return std::min({distance_to_line(a, b, c), distance_to_line(a, b, d), distance_to_line(c, d, a),
                     distance_to_line(c, d, b)}) > tolerance_;
  }

  std::span<const dvec2> outline_;
  double tolerance_;
  std::size_t work_, leaves_;
  std::vector<Box2> boxes_;  // of a complete binary tree: the root is 1, an edge's leaf leaves_ + edge
};

}  // namespace

double outline_tolerance(std::span<const dvec2> outline) {
  dvec2 lo = outline[0], hi = outline[0];
  for (const dvec2& p : outline) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  return 1e-6 * std::max(hi.x - lo.x, hi.y - lo.y);
}

bool outline_crosses(std::span<const dvec2> outline) {
  return Crossings(outline).any();
}

}  // namespace nook
