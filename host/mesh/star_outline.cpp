#include "mesh/star_outline.hpp"

#include <algorithm>
#include <array>

#include "mesh/orientation.hpp"

namespace nook {
namespace {

const dvec2& after(std::span<const dvec2> outline, std::size_t corner) {
  return outline[corner + 1 == outline.size() ? 0 : corner + 1];
}

bool sees_all(const dvec2& centre, std::span<const dvec2> outline) {
  std::size_t turns = 0;  // edges that pass from below the centre to above it, on its right
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const dvec2 &a = outline[i], &b = after(outline, i);
    if (orientation(centre, a, b) <= 0) return false;
    turns += a.y <= centre.y && b.y > centre.y;
  }
  return turns == 1;
}

// What lies on the left of all edges, rounded: the outline's box, cut by one edge after the other. Of more
// than `most` corners it is large enough for its middle.
class Kernel {
 public:
  explicit Kernel(std::span<const dvec2> outline) {
    dvec2 lo = outline[0], hi = outline[0];
    for (const dvec2& p : outline) {
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    }
    for (const dvec2& corner : {lo, dvec2(hi.x, lo.y), hi, dvec2(lo.x, hi.y)}) corners_[size_++] = corner;
    for (std::size_t i = 0; i < outline.size() && size_ > 0 && size_ < most; ++i)
      cut(outline[i], after(outline, i));
  }

  bool empty() const { return size_ == 0; }

  dvec2 middle() const {
    dvec2 sum(0);
    for (std::size_t i = 0; i < size_; ++i) sum += corners_[i] - corners_[0];
    return corners_[0] + sum / double(size_);
  }

 private:
  static constexpr std::size_t most = 32;

  void cut(const dvec2& a, const dvec2& b) {
    // What is read of these was written before.
    std::array<double, most> left;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    bool whole = true;
    for (std::size_t i = 0; i < size_; ++i) {
      const dvec2 e = b - a, p = corners_[i] - a;
      left[i] = e.x * p.y - e.y * p.x;
      whole = whole && left[i] > 0;
    }
    if (whole) return;
    std::array<dvec2, most + 2> kept;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t j = i + 1 == size_ ? 0 : i + 1;
      if (left[i] > 0) kept[count++] = corners_[i];
      if ((left[i] > 0) != (left[j] > 0))
        kept[count++] = corners_[i] + (corners_[j] - corners_[i]) * (left[i] / (left[i] - left[j]));
    }
    size_ = std::min(count, most);
    std::copy_n(kept.begin(), size_, corners_.begin());
  }

  std::array<dvec2, most> corners_ = {};
  std::size_t size_ = 0;
};

}  // namespace

std::optional<dvec2> star_centre(std::span<const dvec2> outline) {
  dvec2 sum(0);
  for (const dvec2& corner : outline) sum += corner - outline[0];
  const dvec2 mean = outline[0] + sum / double(outline.size());
  if (sees_all(mean, outline)) return mean;
  const Kernel kernel(outline);
  if (!kernel.empty() && sees_all(kernel.middle(), outline)) return kernel.middle();
  return {};
}

}  // namespace nook
