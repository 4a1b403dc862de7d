#include "hard_meshes.hpp"

#include <cmath>

#include "support/meshes.hpp"

namespace nook::test {

TriangleMesh with_bounds(TriangleMesh mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle) mesh.bounds.add(mesh.positions[index]);
  return mesh;
}

TriangleMesh sphere_on_floor(float scale, vec3 offset) {
  TriangleMesh mesh = square(100);
  add_sphere(mesh, dvec3(0, 1, 0), 64, [](unsigned, unsigned) { return 1.0; });
  for (vec3& p : mesh.positions) p = vec3(dvec3(p) * double(scale) + dvec3(offset));
  return mesh;
}

TriangleMesh wedge(float angle, float extent) {
  TriangleMesh mesh;
  const auto plate = [&](double turn) {
    const vec3 along(float(extent * std::cos(turn)), float(extent * std::sin(turn)), 0), side(0, 0, extent);
    add_square(mesh, side, -side, along - side, along + side);
  };
  plate(0);
  plate(angle);
  return mesh;
}

TriangleMesh bad_floor(float scale) {
  TriangleMesh mesh;
  constexpr int strips = 64;
  for (int i = 0; i < strips; ++i) {
    const float x0 = -1 + 2 * float(i) / strips, x1 = -1 + 2 * float(i + 1) / strips;
    const float thin = x0 + 2e-5f;
    for (int copy = 0; copy < 2; ++copy) {
      add_square(mesh, {x0, 0, -1}, {x0, 0, 1}, {thin, 0, 1}, {thin, 0, -1});  // facing up
      add_square(mesh, {thin, 0, -1}, {thin, 0, 1}, {x1, 0, 1}, {x1, 0, -1});
    }
    add_square(mesh, {x0, 0, -1}, {thin, 0, -1}, {thin, 0, 1}, {x0, 0, 1});  // facing down
    add_triangle(mesh, {x0, 0, -1}, {x0, 0, 0}, {x0, 0, 1});                 // no area
    add_triangle(mesh, {x0, 0, 0}, {x0, 0, 0}, {x0, 0, 0});
    add_triangle(mesh, {x0, 0, -0.5f}, {x1, 0, -0.5f}, {x0, 0, 0.5f});  // overlaps its neighbours
  }
  for (vec3& p : mesh.positions) p *= scale;
  return mesh;
}

TriangleMesh spiky_star(unsigned n, float inner) {
  TriangleMesh mesh;
  add_sphere(mesh, dvec3(0), n, [&](unsigned i, unsigned j) { return (i + j) % 2 ? 1.0 : double(inner); });
  // Facing inwards: the shading normal is never turned towards the viewer.
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

TriangleMesh square(float half) {
  TriangleMesh mesh;
  add_square(mesh, {-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half});
  return mesh;
}

TriangleMesh single_triangle() {
  TriangleMesh mesh;
  add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  return mesh;
}

TriangleMesh leaning_square(float half, double angle) {
  TriangleMesh mesh = square(half);
  mesh.normals = {vec3(dvec3(std::sin(angle), std::cos(angle), 0))};
  mesh.triangle_normals.assign(mesh.triangles.size(), {0, 0, 0});
  return mesh;
}

TriangleMesh smooth_sphere(unsigned n) {
  TriangleMesh mesh;
  add_sphere(mesh, dvec3(0), n, [](unsigned, unsigned) { return 1.0; });
  for (const vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  mesh.triangle_normals = mesh.triangles;
  return mesh;
}

TriangleMesh shrinking_triangles(int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const float s = std::ldexp(1.0f, -i);
    add_triangle(mesh, vec3(s), vec3(2 * s, s, s), vec3(s, 2 * s, s));
  }
  return mesh;
}

}  // namespace nook::test
