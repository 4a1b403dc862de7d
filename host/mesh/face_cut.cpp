#include "mesh/face_cut.hpp"

#include <algorithm>

#include "mesh/orientation.hpp"
#include "mesh/outline_crossing.hpp"

namespace nook {
namespace {

// Twice the face's area along its normal. From the first corner, so that distance from the origin costs
// nothing.
dvec3 newell_normal(std::span<const dvec3> corners) {
  dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

int largest_axis(const dvec3& v) {
  const dvec3 size = glm::abs(v);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Of a face whose normal is 0: an axis along which it has some extent to both sides.
int axis_of_least_extent(std::span<const dvec3> corners) {
  dvec3 lo = corners[0], hi = corners[0];
  for (const dvec3& c : corners) {
    lo = glm::min(lo, c);
    hi = glm::max(hi, c);
  }
  const dvec3 extent = hi - lo;
  return extent.x <= extent.y && extent.x <= extent.z ? 0 : extent.y <= extent.z ? 1 : 2;
}

// As seen from the axis' end, or from the other one.
void see_along_axis(std::span<const dvec3> corners, int axis, bool from_end, std::vector<dvec2>& seen) {
  int right = (axis + 1) % 3, up = (axis + 2) % 3;
  if (!from_end) std::swap(right, up);
  seen.clear();
  for (const dvec3& c : corners) seen.emplace_back(c[right], c[up]);
}

void see_along(std::span<const dvec3> corners, const dvec3& normal, std::vector<dvec2>& seen) {
  const int axis = largest_axis(normal);
  dvec3 other(0);
  other[(axis + 1) % 3] = 1;
  const dvec3 up = glm::normalize(glm::cross(normal, other)), right = glm::cross(up, glm::normalize(normal));
  seen.clear();
  for (const dvec3& c : corners)
    seen.emplace_back(glm::dot(c - corners[0], right), glm::dot(c - corners[0], up));
}

// In floats, as the triangles will be: the meshes of all formats are cut alike.
bool first_diagonal_shorter(std::span<const dvec3> corners) {
  const auto length2 = [&](std::size_t a, std::size_t b) {
    const vec3 e = vec3(corners[b]) - vec3(corners[a]);
    return e.x * e.x + e.y * e.y + e.z * e.z;
  };
  return length2(0, 2) < length2(1, 3);
}

}  // namespace

bool FaceCutter::cut_quad(std::span<const dvec3> corners, std::vector<Triangle>& triangles) {
  const auto inside = [&](std::size_t a) {  // the diagonal from corner a
    const std::size_t b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
    return orientation(seen_[a], seen_[b], seen_[c]) > 0 && orientation(seen_[a], seen_[c], seen_[d]) > 0;
  };
  const bool first_inside = inside(0), second_inside = inside(1);
  const bool first = first_inside == second_inside ? first_diagonal_shorter(corners) : first_inside;
  triangles.push_back(first ? Triangle{0, 1, 2} : Triangle{0, 1, 3});
  triangles.push_back(first ? Triangle{0, 2, 3} : Triangle{1, 2, 3});
  return first_inside || second_inside || !outline_crosses(seen_);
}

// Every triangle of the fan from the first corner lies to its left, and together they go round it by no more
// than half a turn: they do not overlap.
bool FaceCutter::fan_covers() const {
  const dvec2& hub = seen_[0];
  std::size_t first = 1;
  while (first + 1 < seen_.size() && seen_[first] == hub) ++first;
  for (std::size_t i = 1; i + 1 < seen_.size(); ++i)
    if (orientation(hub, seen_[i], seen_[i + 1]) < 0 || orientation(hub, seen_[first], seen_[i + 1]) < 0)
      return false;
  return true;
}

bool FaceCutter::cut(std::span<const dvec3> corners, std::vector<Triangle>& triangles) {
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
    return true;
  }
  const dvec3 normal = newell_normal(corners);
  const bool flat = normal != dvec3(0);
  const int axis = flat ? largest_axis(normal) : axis_of_least_extent(corners);
  see_along_axis(corners, axis, normal[axis] >= 0, seen_);
  const std::size_t before = triangles.size();
  if (corners.size() == 4) {
    if (cut_quad(corners, triangles)) return true;
  } else if (fan_covers() || !flat) {
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.push_back({0, i, i + 1});
    return flat || !outline_crosses(seen_);
  } else if (clipper_.clip(seen_, triangles)) {
    return true;
  }
  if (!flat) return false;
  const std::vector<Triangle> as_seen(triangles.begin() + std::ptrdiff_t(before), triangles.end());
  triangles.resize(before);
  see_along(corners, normal, seen_);
  if (corners.size() == 4 ? cut_quad(corners, triangles) : clipper_.clip(seen_, triangles)) return true;
  triangles.resize(before);
  triangles.insert(triangles.end(), as_seen.begin(), as_seen.end());
  return false;
}

}  // namespace nook
