#include "support/meshes.hpp"

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

}  // namespace nook::test
