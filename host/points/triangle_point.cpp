#include "points/triangle_point.hpp"

#include <algorithm>

#include "points/points.hpp"

namespace nook {
namespace {

float extent_of(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
  const vec3 size = glm::max(p, glm::max(q, r)) - glm::min(p, glm::min(q, r));
  return std::max({size.x, size.y, size.z});
}

dvec3 normal_at(const TriangleMesh& mesh, std::size_t t, const dvec3& weights) {
  dvec3 sum(0);
  for (int k = 0; mesh.has_normals() && k < 3; ++k) {
    const std::uint32_t normal = mesh.triangle_normals[t][std::size_t(k)];
    if (normal == TriangleMesh::no_normal) return face_normal(mesh, t);
    sum += weights[k] * dvec3(mesh.normals[normal]);
  }
  const double length = glm::length(sum);
  return length > 1e-6 ? sum / length : face_normal(mesh, t);
}

}  // namespace

dvec3 face_normal(const TriangleMesh& mesh, std::size_t triangle) {
  dvec3 p[3];
  for (std::size_t k = 0; k < 3; ++k) p[k] = dvec3(mesh.positions[mesh.triangles[triangle][k]]);
  const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double length = glm::length(n);
  return length > 0 ? n / length : dvec3(0);
}

TrianglePoint triangle_point(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& weights) {
  dvec3 position(0), sum(0);
  for (int k = 0; k < 3; ++k) {
    const dvec3 corner(mesh.positions[mesh.triangles[triangle][std::size_t(k)]]);
    position += weights[k] * corner;
    sum += corner;
  }
  TrianglePoint made{vec3(position), vec3(normal_at(mesh, triangle, weights)), {}, sum / 3.0};
  const vec3 at = glm::abs(made.position), face = vec3(face_normal(mesh, triangle));
  made.point =
      surface_point(made.position, made.normal, vec3(0), glm::dot(face, made.normal) < 0 ? -face : face,
                    std::min(extent_of(mesh, triangle), std::max({at.x, at.y, at.z})));
  made.point.triangle = triangle;
  return made;
}

}  // namespace nook
