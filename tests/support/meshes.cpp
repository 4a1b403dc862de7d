#include "support/meshes.hpp"

#include <cmath>
#include <numbers>

namespace nook::test {

void add_quad(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c, const vec3& d) {
  auto n = std::uint32_t(mesh.positions.size());
  for (const vec3& p : {a, b, c, d}) {
    mesh.positions.push_back(p);
    mesh.bounds.add(p);
  }
  mesh.triangles.push_back({n, n + 1, n + 2});
  mesh.triangles.push_back({n, n + 2, n + 3});
}

void add_quad(TriangleMesh& mesh, const vec3& p, const vec3& u, const vec3& v) {
  add_quad(mesh, p, p + u, p + u + v, p + v);
}

void add_box(TriangleMesh& mesh, const vec3& lo, const vec3& hi, bool inwards) {
  for (int axis = 0; axis < 3; ++axis)
    for (bool upper : {false, true}) {
      int u = (axis + 1) % 3, v = (axis + 2) % 3;
      vec3 corner[4];
      for (int k = 0; k < 4; ++k) {
        corner[k][axis] = upper ? hi[axis] : lo[axis];
        corner[k][u] = k == 1 || k == 2 ? hi[u] : lo[u];
        corner[k][v] = k >= 2 ? hi[v] : lo[v];
      }
      if (upper != inwards)
        add_quad(mesh, corner[0], corner[1], corner[2], corner[3]);
      else
        add_quad(mesh, corner[0], corner[3], corner[2], corner[1]);
    }
}

TriangleMesh courtyard() {
  TriangleMesh mesh;
  add_quad(mesh, {-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  add_quad(mesh, {-2, 2, 0}, {2, 2, 0}, {2, 2, 1.5f}, {-2, 2, 1.5f});
  add_box(mesh, {-0.9f, 0.1f, 0}, {-0.1f, 0.9f, 1.2f});
  add_box(mesh, {0.05f, 0.2f, 0}, {1.1f, 1.0f, 0.4f});
  return mesh;
}

void add_triangle(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_square(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c, const vec3& d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

void add_sphere(TriangleMesh& mesh, const dvec3& center, unsigned n,
                const std::function<double(unsigned, unsigned)>& radius) {
  const auto first = std::uint32_t(mesh.positions.size());
  const auto index = [&](unsigned i, unsigned j) {
    if (i == 0) return first;
    if (i == n) return first + 1;
    return first + 2 + (i - 1) * 2 * n + j % (2 * n);
  };
  const auto place = [&](unsigned i, unsigned j) {
    const double theta = std::numbers::pi * i / n, phi = std::numbers::pi * j / n;
    const dvec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    return vec3(center + radius(i, j) * direction);
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

}  // namespace nook::test
