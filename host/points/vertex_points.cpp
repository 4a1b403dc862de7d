#include "points/vertex_points.hpp"

#include <algorithm>
#include <cmath>

#include "points/outside.hpp"
#include "points/points.hpp"

namespace nook {
namespace {

dvec3 unit_or_zero(const dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : dvec3(0);
}

}  // namespace

std::vector<vec3> position_normals(const TriangleMesh& mesh) {
  std::vector<dvec3> sums(mesh.positions.size(), dvec3(0)), first(sums);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    dvec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = dvec3(mesh.positions[mesh.triangles[t][k]]);
    const dvec3 face = unit_or_zero(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 a = unit_or_zero(p[(k + 1) % 3] - p[k]), b = unit_or_zero(p[(k + 2) % 3] - p[k]);
      const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
      dvec3 normal = face;
      if (mesh.has_normals() && mesh.triangle_normals[t][k] != TriangleMesh::no_normal)
        normal = dvec3(mesh.normals[mesh.triangle_normals[t][k]]);
      const std::uint32_t position = mesh.triangles[t][k];
      sums[position] += angle * normal;
      if (first[position] == dvec3(0)) first[position] = normal;
    }
  }
  // The normals of a sheet seen from both sides cancel; then the first one holds.
  std::vector<vec3> normals(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    normals[i] = vec3(unit_or_zero(glm::length(sums[i]) > 1e-6 ? sums[i] : first[i]));
  return normals;
}

std::vector<SurfacePoint> vertex_points(const TriangleMesh& mesh, const std::vector<vec3>& normals) {
  std::vector<SurfacePoint> points(mesh.positions.size());
  std::vector<float> extent(points.size(), HUGE_VALF);  // of the smallest triangle about a vertex
  std::vector<dvec3> centroids(points.size(), dvec3(0));
  std::vector<std::uint32_t> own(points.size()), count(points.size(), 0);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& [a, b, c] = mesh.triangles[t];
    const vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    const vec3 size = glm::max(p, glm::max(q, r)) - glm::min(p, glm::min(q, r));
    for (const std::uint32_t position : mesh.triangles[t]) {
      points[position].triangle = std::uint32_t(t);
      extent[position] = std::min(extent[position], std::max({size.x, size.y, size.z}));
      centroids[position] += (dvec3(p) + dvec3(q) + dvec3(r)) / 3.0;
      ++count[position];
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    own[i] = std::uint32_t(i);
    const std::uint32_t triangle = points[i].triangle;
    if (count[i] > 0) centroids[i] /= double(count[i]);
    if (normals[i] == vec3(0)) continue;
    points[i] = surface_point(mesh.positions[i], normals[i], vec3(0), normals[i], extent[i]);
    points[i].triangle = triangle;
  }
  move_outside(points, mesh, centroids, own);
  return points;
}

}  // namespace nook
