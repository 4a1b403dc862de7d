#include "mesh/instance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"

namespace nook {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

void check_finite(const vec3& p) {
  if (!finite(p))
    throw Error(ErrorKind::scene, "an instance's transform takes positions beyond the range of floats");
}

vec3 finite_position(const PlacedMesh& place, const vec3& p) {
  const vec3 placed = placed_position(place, p);
  check_finite(placed);
  return placed;
}

// Appends `model`'s per-triangle values, offset; `missing` for all triangles of a mesh without them if the
// other has some.
template <class T, class Offset>
void append_values(std::vector<T>& whole, std::size_t whole_triangles, const std::vector<T>& model,
                   std::size_t model_triangles, const T& missing, Offset offset) {
  if (whole.empty() && model.empty()) return;
  if (whole.empty()) whole.assign(whole_triangles, missing);
  for (std::size_t t = 0; t < model_triangles; ++t)
    whole.push_back(model.empty() ? missing : offset(model[t]));
}

std::array<std::uint32_t, 3> shifted(std::array<std::uint32_t, 3> corners, std::uint32_t offset) {
  for (std::uint32_t& corner : corners)
    if (corner != none) corner += offset;
  return corners;
}

void add_report(TriangleMesh::Report& whole, const TriangleMesh::Report& more) {
  whole.triangles_read += more.triangles_read;
  whole.non_finite_dropped += more.non_finite_dropped;
  whole.normals_replaced += more.normals_replaced;
  whole.normals_normalised += more.normals_normalised;
}

}  // namespace

PlacedMesh placed_mesh(const glm::dmat4& transform) {
  const glm::dmat3 linear(transform);
  const glm::dmat3 for_normals = glm::transpose(glm::inverse(linear));
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(for_normals[column][row]));
  PlacedMesh place{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      place.point[row][column] = float(transform[column][row]);
      if (column < 3) place.normal[row][column] = float(for_normals[column][row] / largest);
    }
  return place;
}

bool mirrors(const glm::dmat4& transform) {
  return glm::determinant(glm::dmat3(transform)) < 0;
}

vec3 placed_position(const PlacedMesh& place, const vec3& p) {
  return {PLACED(place.point[0], p.x, p.y, p.z), PLACED(place.point[1], p.x, p.y, p.z),
          PLACED(place.point[2], p.x, p.y, p.z)};
}

vec3 placed_normal(const PlacedMesh& place, const vec3& n) {
  const PlacedNormal placed = PLACED_NORMAL(place.normal, n.x, n.y, n.z);
  return {placed.x, placed.y, placed.z};
}

Bounds3 placed_bounds(const PlacedMesh& place, const Bounds3& box) {
  Bounds3 placed;
  for (int axis = 0; axis < 3; ++axis) {
    const float* row = place.point[axis];
    vec3 least, most;
    for (int k = 0; k < 3; ++k) {
      least[k] = row[k] < 0 ? box.hi[k] : box.lo[k];
      most[k] = row[k] < 0 ? box.lo[k] : box.hi[k];
    }
    placed.lo[axis] = PLACED(row, least.x, least.y, least.z);
    placed.hi[axis] = PLACED(row, most.x, most.y, most.z);
  }
  return placed;
}

std::uint32_t append_model(TriangleMesh& whole, const TriangleMesh& model, bool mirrored) {
  if (whole.positions.size() + model.positions.size() >= none ||
      whole.normals.size() + model.normals.size() >= none)
    throw Error(ErrorKind::scene, "the scene's instances have more vertices than 32-bit indices can name");
  const auto first_position = std::uint32_t(whole.positions.size()),
             first_normal = std::uint32_t(whole.normals.size());
  const auto first_material = std::uint32_t(whole.materials.size()),
             first_group = std::uint32_t(whole.groups.size());
  const std::size_t before = whole.triangles.size(), count = model.triangles.size();
  const auto oriented = [&](std::array<std::uint32_t, 3> corners) {
    if (mirrored) std::swap(corners[0], corners[2]);  // the edge that corner_order.hpp puts last stays there
    return corners;
  };
  whole.positions.insert(whole.positions.end(), model.positions.begin(), model.positions.end());
  whole.normals.insert(whole.normals.end(), model.normals.begin(), model.normals.end());
  append_values(whole.triangle_normals, before, model.triangle_normals, count, {none, none, none},
                [&](const auto& corners) { return oriented(shifted(corners, first_normal)); });
  append_values(whole.triangle_material, before, model.triangle_material, count, none,
                [&](std::uint32_t m) { return m == none ? none : m + first_material; });
  append_values(whole.triangle_group, before, model.triangle_group, count, none,
                [&](std::uint32_t g) { return g + first_group; });
  const auto first_uv = std::uint32_t(whole.uvs.size());
  append_values(whole.triangle_uvs, before, model.triangle_uvs, count, {none, none, none},
                [&](const auto& corners) { return oriented(shifted(corners, first_uv)); });
  whole.uvs.insert(whole.uvs.end(), model.uvs.begin(), model.uvs.end());
  whole.materials.insert(whole.materials.end(), model.materials.begin(), model.materials.end());
  if (!whole.group_names.empty() || !model.group_names.empty()) {
    whole.group_names.resize(whole.groups.size());
    whole.group_names.insert(whole.group_names.end(), model.group_names.begin(), model.group_names.end());
    whole.group_names.resize(whole.groups.size() + model.groups.size());
  }
  whole.groups.insert(whole.groups.end(), model.groups.begin(), model.groups.end());
  TriangleMesh::Model made{std::uint32_t(before),
                           std::uint32_t(count),
                           first_position,
                           std::uint32_t(model.positions.size()),
                           {},
                           false};
  std::vector<bool> used(model.positions.size());
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t index : triangle) {
      used[index] = true;
      made.bounds.add(model.positions[index]);
    }
    whole.triangles.push_back(oriented(shifted(triangle, first_position)));
  }
  made.all_used = std::find(used.begin(), used.end(), false) == used.end();
  add_report(whole.report, model.report);
  whole.models.push_back(made);
  return std::uint32_t(whole.models.size() - 1);
}

void place_model(TriangleMesh& whole, std::uint32_t index, const glm::dmat4& transform) {
  const TriangleMesh::Model& model = whole.models[index];
  if (whole.scene_triangles() + model.triangles >= none && !whole.instances.empty())
    throw Error(ErrorKind::scene, "the scene's instances have more triangles than 32-bit numbers can name");
  TriangleMesh::Instance instance{placed_mesh(transform), index};
  instance.place.first_triangle = whole.instances.empty() ? 0 : std::uint32_t(whole.scene_triangles());
  instance.place.mesh_triangle = model.first_triangle;
  // Most instances of many lie within the bounds of those before.
  const Bounds3 about = placed_bounds(instance.place, model.bounds);
  Bounds3 with = whole.bounds;
  with.add(about);
  if (with.lo != whole.bounds.lo || with.hi != whole.bounds.hi || !finite(about.lo) || !finite(about.hi)) {
    if (model.all_used)
      for (std::uint32_t i = 0; i < model.positions; ++i)
        whole.bounds.add(finite_position(instance.place, whole.positions[model.first_position + i]));
    else
      for (std::uint32_t t = 0; t < model.triangles; ++t)
        for (const std::uint32_t i : whole.triangles[model.first_triangle + t])
          whole.bounds.add(finite_position(instance.place, whole.positions[i]));
  }
  whole.instances.push_back(instance);
}

void append_instance(TriangleMesh& whole, const TriangleMesh& model, const glm::dmat4& transform) {
  const TriangleMesh::Model made = whole.models[append_model(whole, model, mirrors(transform))];
  whole.models.clear();
  const PlacedMesh place = placed_mesh(transform);
  for (std::uint32_t i = made.first_position; i < whole.positions.size(); ++i)
    whole.positions[i] = placed_position(place, whole.positions[i]);
  for (std::size_t i = whole.normals.size() - model.normals.size(); i < whole.normals.size(); ++i)
    whole.normals[i] = placed_normal(place, whole.normals[i]);
  for (std::uint32_t t = made.first_triangle; t < whole.triangles.size(); ++t)
    for (const std::uint32_t index : whole.triangles[t]) {
      check_finite(whole.positions[index]);
      whole.bounds.add(whole.positions[index]);
    }
}

void append_ground(TriangleMesh& mesh, float height, float reach, Axis up) {
  mesh.subject = mesh.bounds;
  mesh.ground = {height, reach, up};
  const vec3 center = mesh.bounds.center();
  // Counter-clockwise seen from `up`: of y, in x and z.
  const int axis = number_of(up), second = (axis + 1) % 3, first = (axis + 2) % 3;
  const auto corner = [&](float a, float b) {
    vec3 p;
    p[axis] = height;
    p[first] = center[first] + a;
    p[second] = center[second] + b;
    return p;
  };
  TriangleMesh ground;
  ground.positions = {corner(-reach, -reach), corner(-reach, reach), corner(reach, reach),
                      corner(reach, -reach)};
  ground.triangles = {{0, 1, 2}, {2, 3, 0}};
  if (is_opposite(up)) ground.triangles = {{2, 1, 0}, {0, 3, 2}};
  if (!mesh.triangle_group.empty()) {
    ground.groups = {"ground"};
    ground.triangle_group = {0, 0};
  }
  if (mesh.instances.empty())
    append_instance(mesh, ground, glm::dmat4(1));
  else
    place_model(mesh, append_model(mesh, ground, false), glm::dmat4(1));
}

}  // namespace nook
