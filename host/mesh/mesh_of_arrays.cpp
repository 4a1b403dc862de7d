#include "mesh/mesh_of_arrays.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "mesh/corner_order.hpp"

namespace nook {
namespace {

template <class T>
dvec3 vector(std::span<const T> values, std::size_t i) {
  return {double(values[3 * i]), double(values[3 * i + 1]), double(values[3 * i + 2])};
}

template <class T>
void check_vectors(std::span<const T> values, const char* name) {
  if (values.size() % 3 != 0)
    throw Error(ErrorKind::scene, Place{name}, fmt::format("{} numbers, not three a vertex", values.size()));
  for (std::size_t i = 0; i < values.size() / 3; ++i)
    if (!finite(vec3(vector(values, i))))
      throw Error(ErrorKind::scene, Place{name}, fmt::format("row {} is not finite", i));
}

template <class T>
void set_positions(std::span<const T> positions, TriangleMesh& mesh) {
  dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  mesh.positions.resize(positions.size() / 3);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    lo = glm::min(lo, vector(positions, i));
    hi = glm::max(hi, vector(positions, i));
  }
  mesh.frame = frame_for(lo, hi);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = vec3(mesh.frame.from_file(vector(positions, i)));
}

template <class T>
TriangleMesh made_of(std::span<const T> positions, std::span<const std::uint32_t> triangles,
                     std::span<const float> normals) {
  check_vectors(positions, "positions");
  check_vectors(normals, "normals");
  TriangleMesh mesh;
  set_positions(positions, mesh);
  for (std::size_t i = 0; i < normals.size() / 3; ++i) mesh.normals.push_back(vec3(vector(normals, i)));
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

}  // namespace

TriangleMesh mesh_of_arrays(std::span<const float> positions, std::span<const std::uint32_t> triangles,
                            std::span<const float> normals) {
  return made_of(positions, triangles, normals);
}

TriangleMesh mesh_of_arrays(std::span<const double> positions, std::span<const std::uint32_t> triangles,
                            std::span<const float> normals) {
  return made_of(positions, triangles, normals);
}

}  // namespace nook
