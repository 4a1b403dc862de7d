#include "hard_meshes.hpp"

#include <cmath>
#include <numbers>

namespace nook::test {
namespace {

void add_triangle(TriangleMesh& mesh, vec3 a, vec3 b, vec3 c) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_square(TriangleMesh& mesh, vec3 a, vec3 b, vec3 c, vec3 d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

// A sphere of n x 2n facets with shared vertices; radius(i, j) of each.
template <class Radius>
void add_sphere(TriangleMesh& mesh, dvec3 center, unsigned n, Radius radius) {
  const auto first = std::uint32_t(mesh.positions.size());
  const auto index = [&](unsigned i, unsigned j) {
    if (i == 0) return first;
    if (i == n) return first + 1;
    return first + 2 + (i - 1) * 2 * n + j % (2 * n);
  };
  const auto place = [&](unsigned i, unsigned j) {
    const double theta = std::numbers::pi * i / n, phi = std::numbers::pi * j / n;
    const dvec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    return vec3(center + double(radius(i, j)) * direction);
  };
  mesh.positions.push_back(place(0, 0));
  mesh.positions.push_back(place(n, 0));
  for (unsigned i = 1; i < n; ++i)
    for (unsigned j = 0; j < 2 * n; ++j) mesh.positions.push_back(place(i, j));
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < 2 * n; ++j) {
      if (i > 0) mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j + 1)});
      if (i + 1 < n) mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i + 1, j)});
    }
}

}  // namespace

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

TriangleMesh closed_box(unsigned n) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f})
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) {
          const auto at = [&](unsigned s, unsigned t) {
            vec3 p;
            p[axis] = side;
            p[(axis + 1) % 3] = -1 + 2 * float(s) / float(n);
            p[(axis + 2) % 3] = -1 + 2 * float(t) / float(n);
            return p;
          };
          // Facing inwards: the shading normal is never turned towards the viewer.
          if (side < 0)
            add_square(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          else
            add_square(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
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

TriangleMesh shrinking_triangles(int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const float s = std::ldexp(1.0f, -i);
    add_triangle(mesh, vec3(s), vec3(2 * s, s, s), vec3(s, 2 * s, s));
  }
  return mesh;
}

}  // namespace nook::test
