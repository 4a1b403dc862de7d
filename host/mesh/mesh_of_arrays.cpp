#include "mesh/mesh_of_arrays.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "mesh/corner_order.hpp"

namespace nook {
namespace {

std::vector<vec3> vectors(std::span<const float> values, const char* name) {
  if (values.size() % 3 != 0)
    throw Error(ErrorKind::scene, Place{name}, fmt::format("{} numbers, not three a vertex", values.size()));
  std::vector<vec3> made(values.size() / 3);
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    if (!finite(made[i])) throw Error(ErrorKind::scene, Place{name}, fmt::format("row {} is not finite", i));
  }
  return made;
}

}  // namespace

TriangleMesh mesh_of_arrays(std::span<const float> positions, std::span<const std::uint32_t> triangles,
                            std::span<const float> normals) {
  TriangleMesh mesh;
  mesh.positions = vectors(positions, "positions");
  mesh.normals = vectors(normals, "normals");
  if (!normals.empty() && normals.size() != positions.size())
    throw Error(ErrorKind::scene, fmt::format("normals: {} vertices, and {} positions", mesh.normals.size(),
                                              mesh.positions.size()));
  if (triangles.empty() || triangles.size() % 3 != 0)
    throw Error(ErrorKind::scene,
                fmt::format("triangles: {} indices, not three a triangle", triangles.size()));
  for (vec3& normal : mesh.normals)
    if (normal != vec3(0)) normal = vec3(glm::normalize(dvec3(normal)));
  mesh.triangles.resize(triangles.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i] >= mesh.positions.size())
      throw Error(ErrorKind::scene, fmt::format("triangles: row {} names vertex {} of {}", i / 3,
                                                triangles[i], mesh.positions.size()));
    mesh.triangles[i / 3][i % 3] = triangles[i];
    mesh.bounds.add(mesh.positions[triangles[i]]);
  }
  end_with_longest_edges(mesh);
  if (!mesh.normals.empty()) {
    mesh.triangle_normals = mesh.triangles;
    for (auto& corners : mesh.triangle_normals)
      for (std::uint32_t& corner : corners)
        if (mesh.normals[corner] == vec3(0)) corner = TriangleMesh::no_normal;
  }
  mesh.report.triangles_read = mesh.triangles.size();
  return mesh;
}

}  // namespace nook
