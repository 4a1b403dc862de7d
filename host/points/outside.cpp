#include "points/outside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/instance.hpp"

namespace nook {
namespace {

constexpr double half_ulp = 0x1p-24;

dvec3 origin_of(const SurfacePoint& p) {
  return {p.origin[0], p.origin[1], p.origin[2]};
}

dvec3 normal_of(const SurfacePoint& p) {
  return {p.normal[0], p.normal[1], p.normal[2]};
}

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// The points by place: cells of a grid over their bounds, about one a point.
class PointGrid {
 public:
  explicit PointGrid(std::span<const SurfacePoint> points) {
    std::size_t count = 0;
    for (const SurfacePoint& p : points)
      if (used(p)) ++count, lo_ = glm::min(lo_, origin_of(p)), hi_ = glm::max(hi_, origin_of(p));
    side_ = std::clamp(int(std::cbrt(double(count))), 1, 128);
    first_.assign(std::size_t(side_) * std::size_t(side_) * std::size_t(side_) + 1, 0);
    for (const SurfacePoint& p : points)
      if (used(p)) ++first_[cell_of(p) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    points_.resize(count);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (used(points[i])) points_[next[cell_of(points[i])]++] = std::uint32_t(i);
  }

  // Whether a box reaches any cell, and those of its points.
  bool misses(const dvec3& lo, const dvec3& hi) const {
    return points_.empty() || glm::any(glm::lessThan(hi, lo_)) || glm::any(glm::greaterThan(lo, hi_));
  }
  template <class Visit>
  void visit(const dvec3& lo, const dvec3& hi, const Visit& of_point) const {
    if (misses(lo, hi)) return;
    std::array<int, 3> from{}, to{};
    for (int axis = 0; axis < 3; ++axis) from[axis] = cell(lo, axis), to[axis] = cell(hi, axis);
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y) {
        const std::size_t row = (std::size_t(z) * std::size_t(side_) + std::size_t(y)) * std::size_t(side_);
        for (std::uint32_t i = first_[row + std::size_t(from[0])]; i < first_[row + std::size_t(to[0]) + 1];
             ++i)
          of_point(points_[i]);
      }
  }

 private:
  static bool used(const SurfacePoint& p) {
    return (p.flags & SURFACE_HIT) && std::isfinite(largest(origin_of(p)));
  }
  int cell(const dvec3& p, int axis) const {
    const double size = hi_[axis] - lo_[axis];
    return size > 0 ? int(std::clamp((p[axis] - lo_[axis]) / size * side_, 0.0, side_ - 1.0)) : 0;
  }
  std::size_t cell_of(const SurfacePoint& p) const {
    const dvec3 o = origin_of(p);
    return (std::size_t(cell(o, 2)) * std::size_t(side_) + std::size_t(cell(o, 1))) * std::size_t(side_) +
           std::size_t(cell(o, 0));
  }

  dvec3 lo_{HUGE_VAL}, hi_{-HUGE_VAL};
  int side_ = 1;
  std::vector<std::uint32_t> first_, points_;
};

// A triangle, and how far its plane is from where the file has it at most: its corners' roundings.
struct Facet {
  std::array<dvec3, 3> corner;
  dvec3 normal{0};      // unit; 0: no area
  double rounding = 0;  // along the normal
  double slack = 0;     // in any direction
  double extent = 0;

  explicit Facet(const std::array<vec3, 3>& p) : corner{dvec3(p[0]), dvec3(p[1]), dvec3(p[2])} {
    const dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double length = glm::length(n);
    if (length > 0) normal = n / length;
    const dvec3 far = glm::max(glm::abs(corner[0]), glm::max(glm::abs(corner[1]), glm::abs(corner[2])));
    slack = 4 * half_ulp * largest(far);
    rounding = 4 * half_ulp * glm::dot(glm::abs(normal), far);
    extent = largest(hi() - lo());
  }
  dvec3 lo() const { return glm::min(corner[0], glm::min(corner[1], corner[2])) - slack; }
  dvec3 hi() const { return glm::max(corner[0], glm::max(corner[1], corner[2])) + slack; }
  double height(const dvec3& p) const { return glm::dot(normal, p - corner[0]); }
  // Whether its foot in the plane lies within the triangle or within `slack` of it.
  bool holds(const dvec3& p) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 edge = corner[(i + 1) % 3] - corner[i], inwards = glm::cross(normal, edge);
      if (glm::dot(inwards, p - corner[i]) < -slack * glm::length(edge)) return false;
    }
    return true;
  }
};

// The least move that takes the origin surely to the side of `towards` (unit) of the facet's plane.
void move_to(SurfacePoint& point, const Facet& facet, const dvec3& towards) {
  const dvec3 o = origin_of(point);
  const double height = glm::dot(towards, o - facet.corner[0]);
  double off = 0x1p-26 * std::min(facet.extent, largest(o)) + 0x1p-40 * facet.extent + 0x1p-60;
  for (int i = 0; i < 3; ++i) off += 4 * half_ulp * std::abs(towards[i] * o[i]);
  if (height >= off) return;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(towards[i]) < 1e-12) continue;
    const auto moved = float(o[i] + (off - height) * towards[i]);
    point.origin[i] = std::nextafter(moved, towards[i] > 0 ? HUGE_VALF : -HUGE_VALF);
  }
}

class Mover {
 public:
  Mover(std::span<SurfacePoint> points, const TriangleMesh& mesh, std::span<const dvec3> centroids,
        std::span<const std::uint32_t> own)
      : points_(points), mesh_(mesh), centroids_(centroids), own_(own), grid_(points) {}

  void run() {
    if (mesh_.instances.empty()) {
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) meet(t, [](const vec3& p) { return p; });
      leave_contacts();
      return;
    }
    for (const TriangleMesh::Instance& instance : mesh_.instances) {
      const TriangleMesh::Model& model = mesh_.models[instance.model];
      const Bounds3 about = placed_bounds(instance.place, model.bounds);
      const double slack = 4 * half_ulp * std::max(largest(dvec3(about.lo)), largest(dvec3(about.hi)));
      if (grid_.misses(dvec3(about.lo) - slack, dvec3(about.hi) + slack)) continue;
      for (std::uint32_t t = 0; t < model.triangles; ++t)
        meet(model.first_triangle + t, [&](const vec3& p) { return placed_position(instance.place, p); });
    }
  }

 private:
  template <class Place>
  void meet(std::uint32_t triangle, const Place& place) {
    std::array<vec3, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = place(mesh_.positions[mesh_.triangles[triangle][k]]);
    const Facet facet(p);
    if (facet.normal == dvec3(0)) return;
    grid_.visit(facet.lo(), facet.hi(), [&](std::uint32_t i) { meet_point(triangle, facet, i); });
  }

  void meet_point(std::uint32_t triangle, const Facet& facet, std::uint32_t i) {
    SurfacePoint& point = points_[i];
    // Where it was before it was moved off its own surface, but for roundings.
    const dvec3 o = origin_of(point) - double(point.distance) * normal_of(point);
    if (std::abs(facet.height(o)) > facet.rounding + 0.5 * std::abs(point.distance) || !facet.holds(o))
      return;
    const double facing = glm::dot(facet.normal, normal_of(point));
    if (!centroids_.empty()) {
      if (!is_own(triangle, i)) contacts_.emplace_back(i, facet);
    } else {
      move_to(point, facet, facing < -0.5 ? -facet.normal : facet.normal);
    }
  }

  // First along the point's own surface towards its middle, where that is one: off the line in which it meets
  // the other one.
  void leave_contacts() {
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const std::uint32_t i = contacts_[c].first;
      if (c > 0 && contacts_[c - 1].first == i) continue;
      const dvec3 o = origin_of(points_[i]), n = normal_of(points_[i]), in = centroids_[i] - o;
      const dvec3 along = in - glm::dot(in, n) * n;
      if (glm::length(along) < 0.5 * glm::length(in)) continue;  // in the middle of its own surface
      const dvec3 moved = o + 0x1p-16 * along;
      for (int axis = 0; axis < 3; ++axis) points_[i].origin[axis] = float(moved[axis]);
    }
    for (const auto& [i, facet] : contacts_) {
      SurfacePoint& point = points_[i];
      const double side = facet.height(centroids_[i]);
      const bool in_plane =
          std::abs(side) <= 2 * facet.rounding + 1e-6 * glm::length(centroids_[i] - facet.corner[0]);
      const dvec3 towards = in_plane || side > 0 ? facet.normal : -facet.normal;
      if (in_plane || !own_.empty() || glm::dot(towards, normal_of(point)) >= 0)
        move_to(point, facet, towards);
    }
  }

  bool is_own(std::uint32_t triangle, std::uint32_t i) const {
    if (own_.empty()) return points_[i].triangle == triangle;
    const auto& corners = mesh_.triangles[triangle];
    return std::find(corners.begin(), corners.end(), own_[i]) != corners.end();
  }

  std::span<SurfacePoint> points_;
  const TriangleMesh& mesh_;
  std::span<const dvec3> centroids_;
  std::span<const std::uint32_t> own_;
  PointGrid grid_;
  std::vector<std::pair<std::uint32_t, Facet>> contacts_;  // points on triangles that are not their own
};

}  // namespace

void move_outside(std::span<SurfacePoint> points, const TriangleMesh& mesh, std::span<const dvec3> centroids,
                  std::span<const std::uint32_t> own) {
  if (!points.empty()) Mover(points, mesh, centroids, own).run();
}

}  // namespace nook
