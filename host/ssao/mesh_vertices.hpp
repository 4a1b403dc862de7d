#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A mesh as OpenGL draws it: position and normal interleaved, 6 floats a vertex, and three vertices a
/// triangle.
struct MeshVertices {
  using Triangle = std::array<std::uint32_t, 3>;
  std::vector<float> values;
  std::vector<Triangle> triangles;

  std::uint32_t add(const vec3& position, const vec3& normal) {
    values.insert(values.end(), {position.x, position.y, position.z, normal.x, normal.y, normal.z});
    return std::uint32_t(values.size() / 6 - 1);
  }
  std::size_t triangle_bytes() const { return triangles.size() * sizeof(Triangle); }
  std::size_t bytes() const { return values.size() * sizeof(float) + triangle_bytes(); }
};

/// With vertex normals, where the mesh has them; without, the normal is the flat attribute of each triangle's
/// last vertex (OpenGL's provoking vertex).
MeshVertices mesh_vertices(const TriangleMesh& mesh);

}  // namespace nook
