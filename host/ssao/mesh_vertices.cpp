#include "ssao/mesh_vertices.hpp"

#include <algorithm>
#include <unordered_map>

namespace nook {
namespace {

using Triangle = MeshVertices::Triangle;

// Unit, from the winding, in double precision: a triangle of size 1e-15 would underflow.
vec3 geometric_normal(const TriangleMesh& mesh, const Triangle& triangle) {
  const dvec3 p = mesh.positions[triangle[0]];
  const dvec3 n = glm::cross(dvec3(mesh.positions[triangle[1]]) - p, dvec3(mesh.positions[triangle[2]]) - p);
  const double length = glm::length(n);
  return length > 0 ? vec3(n / length) : vec3(0, 0, 1);
}

// With vertex normals: one vertex for each pair of position and normal that occurs. A triangle that lacks a
// normal at any corner has its geometric normal at all three.
MeshVertices smooth_vertices(const TriangleMesh& mesh) {
  MeshVertices vertices;
  vertices.triangles.reserve(mesh.triangles.size());
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  known.reserve(mesh.positions.size() * 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle &positions = mesh.triangles[t], &normals = mesh.triangle_normals[t];
    const bool smooth = std::find(normals.begin(), normals.end(), TriangleMesh::no_normal) == normals.end();
    const vec3 geometric = smooth ? vec3(0) : geometric_normal(mesh, positions);
    Triangle& out = vertices.triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) {
      const vec3 position = mesh.positions[positions[corner]];
      if (!smooth) {
        out[corner] = vertices.add(position, geometric);
        continue;
      }
      const std::uint64_t key = std::uint64_t(positions[corner]) << 32 | normals[corner];
      const auto [entry, is_new] = known.try_emplace(key, 0);
      if (is_new) entry->second = vertices.add(position, mesh.normals[normals[corner]]);
      out[corner] = entry->second;
    }
  }
  return vertices;
}

// Without vertex normals: a triangle's normal is the flat attribute of its last vertex (OpenGL's provoking
// vertex). Each triangle is turned to end in a vertex that no other triangle ends in; where there is none
// left, the vertex is doubled.
MeshVertices flat_vertices(const TriangleMesh& mesh) {
  MeshVertices vertices;
  vertices.triangles = mesh.triangles;
  for (const vec3& position : mesh.positions) vertices.add(position, vec3(0));
  std::vector<bool> taken(mesh.positions.size());
  for (Triangle& triangle : vertices.triangles) {
    const vec3 normal = geometric_normal(mesh, triangle);
    for (int turn = 0; turn < 2 && taken[triangle[2]]; ++turn)
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    std::uint32_t& last = triangle[2];
    if (taken[last]) {
      last = vertices.add(mesh.positions[last], normal);
    } else {
      taken[last] = true;
      for (int axis = 0; axis < 3; ++axis)
        vertices.values[6 * std::size_t(last) + 3 + std::size_t(axis)] = normal[axis];
    }
  }
  return vertices;
}

}  // namespace

MeshVertices mesh_vertices(const TriangleMesh& mesh) {
  return mesh.has_normals() ? smooth_vertices(mesh) : flat_vertices(mesh);
}

}  // namespace nook
