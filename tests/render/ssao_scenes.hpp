#pragma once

#include <optional>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"
#include "support/meshes.hpp"

namespace nook::test {

/// Appends the box from p to p + size, seen from outside.
inline void add_box_of(TriangleMesh& mesh, const vec3& p, const vec3& size) {
  add_box(mesh, p, p + size);
}

/// A floor and three boxes without any symmetry: a mirrored, turned or flipped picture differs everywhere.
inline TriangleMesh asymmetric_scene() {
  TriangleMesh mesh;
  add_quad(mesh, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  add_box_of(mesh, {-1.3f, 0, -0.4f}, {0.5f, 0.9f, 0.6f});
  add_box_of(mesh, {0.2f, 0, 0.3f}, {0.9f, 0.3f, 0.2f});
  add_box_of(mesh, {0.4f, 0.7f, -1.1f}, {0.3f, 0.3f, 0.3f});
  return mesh;
}

inline const Camera asymmetric_camera{{1.1f, 1.7f, 3.1f}, {-0.1f, 0.3f, 0}, {0.1f, 1, 0}, 40};

/// Gives every triangle vertex normals that differ from its geometric normal, by leaning them outwards from
/// the origin.
inline void add_leaning_normals(TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    const vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]],
               c = mesh.positions[triangle[2]];
    const vec3 geometric = glm::normalize(glm::cross(b - a, c - a));
    const auto first = std::uint32_t(mesh.normals.size());
    for (const std::uint32_t corner : triangle)
      mesh.normals.push_back(glm::normalize(geometric + 0.4f * mesh.positions[corner]));
    mesh.triangle_normals.push_back({first, first + 1, first + 2});
  }
}

struct ExactHit {
  std::size_t triangle;
  double u, v;  ///< hit = (1-u-v) p0 + u p1 + v p2
  dvec3 position, normal;
};

/// The nearest hit of the ray in double precision, by trying every triangle; the normal is the shading
/// normal.
inline std::optional<ExactHit> cast_exactly(const TriangleMesh& mesh, const dvec3& origin,
                                            const dvec3& direction) {
  std::optional<ExactHit> nearest;
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const dvec3 p0 = mesh.positions[mesh.triangles[i][0]], p1 = mesh.positions[mesh.triangles[i][1]],
                p2 = mesh.positions[mesh.triangles[i][2]];
    const dvec3 n = glm::cross(p1 - p0, p2 - p0);
    const double t = glm::dot(n, p0 - origin) / glm::dot(n, direction);
    if (!(t > 0 && t < limit)) continue;
    const dvec3 hit = origin + t * direction;
    const double u = glm::dot(n, glm::cross(p2 - hit, p0 - hit)) / glm::dot(n, n);
    const double v = glm::dot(n, glm::cross(p0 - hit, p1 - hit)) / glm::dot(n, n);
    if (u < 0 || v < 0 || u + v > 1) continue;
    dvec3 normal = n;
    if (mesh.has_normals()) {
      const auto& index = mesh.triangle_normals[i];
      normal = (1 - u - v) * dvec3(mesh.normals[index[0]]) + u * dvec3(mesh.normals[index[1]]) +
               v * dvec3(mesh.normals[index[2]]);
    }
    limit = t;
    nearest = ExactHit{i, u, v, hit, glm::normalize(normal)};
  }
  return nearest;
}

}  // namespace nook::test
