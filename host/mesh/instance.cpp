#include "mesh/instance.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace nook {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Appends `part`'s per-triangle values, offset; `missing` for all triangles of a mesh without them if the
// other has some.
template <class T, class Offset>
void append_values(std::vector<T>& whole, std::size_t whole_triangles, const std::vector<T>& part,
                   std::size_t part_triangles, const T& missing, Offset offset) {
  if (whole.empty() && part.empty()) return;
  if (whole.empty()) whole.assign(whole_triangles, missing);
  for (std::size_t t = 0; t < part_triangles; ++t) whole.push_back(part.empty() ? missing : offset(part[t]));
}

std::array<std::uint32_t, 3> shifted(std::array<std::uint32_t, 3> corners, std::uint32_t offset) {
  for (std::uint32_t& corner : corners)
    if (corner != none) corner += offset;
  return corners;
}

void add_report(TriangleMesh::Report& whole, const TriangleMesh::Report& part) {
  whole.triangles_read += part.triangles_read;
  whole.non_finite_dropped += part.non_finite_dropped;
  whole.normals_replaced += part.normals_replaced;
  whole.normals_normalised += part.normals_normalised;
}

}  // namespace

void append_instance(TriangleMesh& whole, const TriangleMesh& part, const glm::dmat4& transform) {
  if (whole.positions.size() + part.positions.size() >= none ||
      whole.normals.size() + part.normals.size() >= none)
    throw Error(ExitCode::scene, "the scene's instances have more vertices than 32-bit indices can name");
  const auto first_position = std::uint32_t(whole.positions.size()),
             first_normal = std::uint32_t(whole.normals.size());
  const auto first_material = std::uint32_t(whole.materials.size()),
             first_group = std::uint32_t(whole.groups.size());
  const std::size_t before = whole.triangles.size(), count = part.triangles.size();
  const glm::dmat3 linear(transform);
  const glm::dmat3 for_normals = glm::transpose(glm::inverse(linear));
  const bool mirrors = glm::determinant(linear) < 0;

  for (const vec3& p : part.positions)
    whole.positions.push_back(vec3(glm::dvec3(transform * glm::dvec4(dvec3(p), 1))));
  for (const vec3& n : part.normals) {
    const dvec3 turned = for_normals * dvec3(n);
    const double length = glm::length(turned);
    whole.normals.push_back(length > 0 ? vec3(turned / length) : vec3(0));
  }
  const auto oriented = [&](std::array<std::uint32_t, 3> corners) {
    if (mirrors) std::swap(corners[1], corners[2]);
    return corners;
  };
  append_values(whole.triangle_normals, before, part.triangle_normals, count, {none, none, none},
                [&](const auto& corners) { return oriented(shifted(corners, first_normal)); });
  append_values(whole.triangle_material, before, part.triangle_material, count, none,
                [&](std::uint32_t m) { return m == none ? none : m + first_material; });
  append_values(whole.triangle_group, before, part.triangle_group, count, none,
                [&](std::uint32_t g) { return g + first_group; });
  const auto first_uv = std::uint32_t(whole.uvs.size());
  append_values(whole.triangle_uvs, before, part.triangle_uvs, count, {none, none, none},
                [&](const auto& corners) { return oriented(shifted(corners, first_uv)); });
  whole.uvs.insert(whole.uvs.end(), part.uvs.begin(), part.uvs.end());
  whole.materials.insert(whole.materials.end(), part.materials.begin(), part.materials.end());
  whole.groups.insert(whole.groups.end(), part.groups.begin(), part.groups.end());
  for (const auto& triangle : part.triangles) {
    const auto placed = oriented(shifted(triangle, first_position));
    for (const std::uint32_t index : placed) {
      if (!finite(whole.positions[index]))
        throw Error(ExitCode::scene, "an instance's transform takes positions beyond the range of floats");
      whole.bounds.add(whole.positions[index]);
    }
    whole.triangles.push_back(placed);
  }
  add_report(whole.report, part.report);
}

void append_ground(TriangleMesh& mesh, float height, float reach) {
  mesh.subject = mesh.bounds;
  const vec3 center = mesh.bounds.center();
  TriangleMesh ground;
  ground.positions = {{center.x - reach, height, center.z - reach},
                      {center.x - reach, height, center.z + reach},
                      {center.x + reach, height, center.z + reach},
                      {center.x + reach, height, center.z - reach}};
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (!mesh.triangle_group.empty()) {
    ground.groups = {"ground"};
    ground.triangle_group = {0, 0};
  }
  append_instance(mesh, ground, glm::dmat4(1));
}

}  // namespace nook
