#include "plan/coarse_triangle.hpp"

#include <algorithm>
#include <cmath>

namespace nook {
namespace {

double largest(const dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - a - t * along);
}

}  // namespace

double resolution_of(const dvec3& n, const dvec3& sides, const dvec3& far) {
  return 0x1.4p-17 * glm::dot(glm::abs(n), glm::max(sides, 0.125 * far)) + 0x1p-31 * largest(sides);
}

CoarseTriangle::CoarseTriangle(std::uint64_t its_number, const vec3& a, const vec3& b, const vec3& c)
    : number(its_number), corner{dvec3(a), dvec3(b), dvec3(c)} {
  const dvec3 u = corner[1] - corner[0], v = corner[2] - corner[0], n = glm::cross(u, v);
  const double area = glm::length(n);
  if (!(area > 0)) return;
  normal = n / area;
  const dvec3 sides(glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c)));
  const dvec3 out(glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
  extent = largest(sides);
  far = largest(out);
  width = area / std::sqrt(std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(v - u, v - u)}));
  resolution = resolution_of(normal, sides, out);
}

double CoarseTriangle::width_resolution() const {
  return std::max(resolution, edge_resolution * extent);
}

double CoarseTriangle::distance(const dvec3& p) const {
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i)
    inside = inside && glm::dot(glm::cross(normal, corner[(i + 1) % 3] - corner[i]), p - corner[i]) >= 0;
  if (inside) return std::abs(glm::dot(normal, p - corner[0]));
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, distance_to_segment(p, corner[i], corner[(i + 1) % 3]));
  return least;
}

bool CoarseTriangle::coarser_than(const CoarseTriangle& other) const {
  return resolution != other.resolution ? resolution > other.resolution : number < other.number;
}

void CoarsestFor::add(const CoarseTriangle& other, double its_resolution, double at) {
  const double its_excess = its_resolution / at;
  if (!(its_excess > 1) || its_excess < excess()) return;
  if (triangle && its_excess == excess() && triangle->number < other.number) return;
  triangle = other, resolution = its_resolution, distance = at;
}

}  // namespace nook
