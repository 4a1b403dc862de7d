#include "bench/support/bench_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <random>

#include "base/error.hpp"
#include "mesh/corner_order.hpp"
#include "mesh/obj_loader.hpp"
#include "support/meshes.hpp"

namespace nook::bench {
namespace {

using test::add_quad;

/// A box between two corners, turned about the vertical axis through its centre.
void add_turned_box(TriangleMesh& mesh, const vec3& lo, const vec3& hi, float turn) {
  const vec3 center = (lo + hi) * 0.5f;
  const auto corner = [&](int i) {
    const vec3 p = vec3(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z) - center;
    return center + vec3(std::cos(turn) * p.x - std::sin(turn) * p.z, p.y,
                         std::sin(turn) * p.x + std::cos(turn) * p.z);
  };
  const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& f : faces) add_quad(mesh, corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3]));
}

/// n x m quads of a parametric surface over [0,1]^2.
void add_surface(TriangleMesh& mesh, int n, int m, const std::function<vec3(double, double)>& point) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) mesh.positions.push_back(point(double(i) / n, double(j) / m));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const std::uint32_t a = first + std::uint32_t(i * (m + 1) + j), b = a + std::uint32_t(m) + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
}

/// A tube of the given radius about a (p, q) torus knot.
void add_knot(TriangleMesh& mesh, const vec3& center, float size, int p, int q, float radius, int n, int m) {
  const auto curve = [=](double t) {
    const double a = 2 * M_PI * t, r = 2 + std::cos(q * a);
    return dvec3(r * std::cos(p * a), std::sin(q * a), r * std::sin(p * a)) / 3.0;
  };
  add_surface(mesh, n, m, [=](double s, double t) {
    const dvec3 c = curve(s), tangent = glm::normalize(curve(s + 1e-4) - c);
    const dvec3 u = glm::normalize(glm::cross(tangent, dvec3(0.1, 1, 0.2))), v = glm::cross(tangent, u);
    const double phi = 2 * M_PI * t;
    return vec3(dvec3(center) +
                double(size) * (c + double(radius) * (std::cos(phi) * u + std::sin(phi) * v)));
  });
}

/// Midpoint subdivision: four triangles of each.
TriangleMesh subdivide(const TriangleMesh& in) {
  TriangleMesh out;
  out.positions = in.positions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), std::uint32_t(out.positions.size()));
    if (fresh) out.positions.push_back((in.positions[a] + in.positions[b]) * 0.5f);
    return it->second;
  };
  for (const auto& t : in.triangles) {
    const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    out.triangles.insert(out.triangles.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
  }
  return out;
}

BenchScene bunny() {
  TriangleMesh mesh = load_obj("/usr/share/glmark2/models/bunny.obj", {.normals = false});
  mesh.triangle_normals.clear();
  for (int i = 0; i < 2; ++i) mesh = subdivide(mesh);
  Bounds3 box;
  for (const vec3& p : mesh.positions) box.add(p);
  const vec3 c = box.center();
  const float floor = box.lo.y + 0.02f * (box.hi.y - box.lo.y), r = 4 * box.bounding_radius();
  add_quad(mesh, {c.x - r, floor, c.z - r}, {c.x - r, floor, c.z + r}, {c.x + r, floor, c.z + r},
           {c.x + r, floor, c.z - r});
  const float d = box.bounding_radius();
  return {"bunny", std::move(mesh), c + vec3(0.5f, 0.9f, 2.2f) * d, c - vec3(0, 0.2f, 0) * d, 40};
}

BenchScene room() {
  TriangleMesh mesh;
  const auto bumps = [](double u, double v) { return 0.02 * std::sin(40 * u) * std::sin(37 * v); };
  add_surface(mesh, 200, 200, [&](double u, double v) { return vec3(8 * u - 4, bumps(u, v), 8 * v - 4); });
  add_surface(mesh, 60, 60, [&](double u, double v) { return vec3(8 * v - 4, 3 + bumps(u, v), 8 * u - 4); });
  add_surface(mesh, 100, 60, [&](double u, double v) { return vec3(8 * u - 4, 3.1 * v, -4 + bumps(u, v)); });
  add_surface(mesh, 100, 60, [&](double u, double v) { return vec3(8 * u - 4, 3.1 * v, 4 + bumps(u, v)); });
  add_surface(mesh, 100, 60, [&](double u, double v) { return vec3(-4 + bumps(u, v), 3.1 * v, 8 * u - 4); });
  add_surface(mesh, 100, 60, [&](double u, double v) { return vec3(4 + bumps(u, v), 3.1 * v, 8 * u - 4); });
  std::mt19937 random(7);
  const auto uniform = [&](float lo, float hi) { return lo + (hi - lo) * float(random() >> 8) * 0x1p-24f; };
  for (int i = 0; i < 40; ++i) {
    const float x = uniform(-3.6f, 3.6f), z = uniform(-3.6f, 2.0f), w = uniform(0.1f, 0.4f),
                h = uniform(0.2f, 1.0f);
    add_turned_box(mesh, {x - w, 0, z - w}, {x + w, h, z + w}, uniform(0, 3));
    if (i % 2) {
      add_knot(mesh, {x, h + 0.35f, z}, uniform(0.2f, 0.4f), 2 + i % 3, 3 + i % 4, 0.12f, 600, 36);
    } else {
      const float r = uniform(0.1f, 0.3f);
      add_surface(mesh, 40, 80, [=](double u, double v) {
        const double s = std::sin(M_PI * u);
        return vec3(x + r * s * std::cos(2 * M_PI * v), h + r + r * std::cos(M_PI * u),
                    z + r * s * std::sin(2 * M_PI * v));
      });
    }
  }
  return {"room", std::move(mesh), {2.6f, 1.7f, 3.6f}, {-0.6f, 0.7f, -0.6f}, 60};
}

/// A knotted tube above a floor, of about as many triangles as are asked for: one shape at any fineness.
BenchScene knot(double triangles) {
  const int m = std::max(3, int(std::lround(std::sqrt(triangles / 32)))), n = 16 * m;
  TriangleMesh mesh;
  add_knot(mesh, {0, 0.6f, 0}, 1.0f, 2, 3, 0.15f, n, m);
  add_quad(mesh, {-6, 0, -6}, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6});
  return {"knot", std::move(mesh), {1.6f, 2.2f, 2.4f}, {0, 0.5f, 0}, 40};
}

/// Five walls, two blocks and a lamp.
BenchScene cornell() {
  TriangleMesh mesh;
  add_quad(mesh, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1});
  add_quad(mesh, {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1});
  add_quad(mesh, {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1});
  add_quad(mesh, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, {-1, 0, 1});
  add_quad(mesh, {1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1});
  add_quad(mesh, {-0.25f, 1.99f, -0.25f}, {0.25f, 1.99f, -0.25f}, {0.25f, 1.99f, 0.25f},
           {-0.25f, 1.99f, 0.25f});
  add_turned_box(mesh, {-0.65f, 0, -0.6f}, {-0.05f, 1.2f, 0}, 0.3f);
  add_turned_box(mesh, {0.05f, 0, 0.05f}, {0.65f, 0.6f, 0.65f}, -0.3f);
  return {"cornell", std::move(mesh), {0, 1, 3.6f}, {0, 1, 0}, 40};
}

BenchScene from_file(const std::string& name, const std::string& path) {
  BenchScene scene{name, load_obj(path, {.normals = false}), {}, {}, 40};
  Bounds3 box;
  for (const auto& t : scene.mesh.triangles)
    for (const std::uint32_t i : t) box.add(scene.mesh.positions[i]);
  scene.at = box.center();
  scene.eye = scene.at + vec3(1.2f, 0.7f, 1.2f) * box.bounding_radius();
  return scene;
}

BenchScene made(const std::string& name) {
  if (name == "bunny") return bunny();
  if (name == "room") return room();
  if (name == "cornell") return cornell();
  if (name.starts_with("knot:")) return knot(std::stod(name.substr(5)));
  if (name == "spaceship") {
    BenchScene scene = from_file(name, NOOK_SOURCE_DIR "/scenes/generated/spaceship.obj");
    scene.eye = {4.5f, 0.65f, -0.15f};  // the course's camera
    scene.at = {0, 0.65f, -0.15f};
    scene.fov = 30;
    return scene;
  }
  if (std::filesystem::exists(name)) return from_file(std::filesystem::path(name).stem(), name);
  throw Error(ErrorKind::usage,
              "unknown scene '" + name + "': bunny, room, cornell, spaceship or an OBJ file");
}

}  // namespace

BenchScene bench_scene(const std::string& name) {
  BenchScene scene = made(name);
  end_with_longest_edges(scene.mesh);  // as a loader leaves it
  return scene;
}

}  // namespace nook::bench
