// Which side of a surface is looked from, against closed forms. Receiver at the origin, normal +z. Under an
// endless ceiling at height h, a direction at cosine m to the normal meets it at t = h/m; with c = h/R (R the
// distance limit) cosine-weighted values are integrals over 2 m dm, and the directions with m < c are open.
#include <gtest/gtest.h>

#include <cmath>

#include "effects_geometry.hpp"

namespace nook::test {
namespace {

constexpr double c = 0.5;  // h = 1, R = 2

// AO on the normal's side, and on the viewer's.
Scene of_both_sides(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  scene.width = scene.height = 8;
  scene.spp = 64;
  scene.effects = {ao_within(2), ao_within(2)};
  scene.effects[1].side = Side::viewer;
  return scene;
}

// A slab of thickness 1 under the receiver: looking inside is looking at a ceiling; the outside is open.
TEST(Side, InsideLooksTheOtherWay) {
  TriangleMesh slab = plane_at(0);
  const TriangleMesh bottom = plane_at(-1);
  add_quad(slab, bottom.positions[0], bottom.positions[1] - bottom.positions[0],
           bottom.positions[3] - bottom.positions[0]);
  Effect effect = ao_within(2);
  EXPECT_EQ(estimate_at_origin(slab, effect).value(0), 1);
  effect.side = Side::inside;
  expect_value(estimate_at_origin(slab, effect), c * c);
}

// What camera rays find, too: from above, the slab's inside is the same everywhere.
TEST(Side, InsideOfASlabUnderTheCamera) {
  TriangleMesh slab = plane_at(0);
  add_quad(slab, {-1000, -1000, -1}, {2000, 0, 0}, {0, 2000, 0});
  Scene scene;
  scene.camera = {{0.3f, 0.4f, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.width = scene.height = 16;
  scene.spp = 64;
  scene.effects = {ao_within(2)};
  scene.effects[0].side = Side::inside;
  const std::vector<Film> films = films_of(scene, slab);
  EXPECT_NEAR(mean_of(films[0]), c * c, 4 * std::sqrt(0.1875 / (256 * 64)));
}

// A plane with its normal upwards, a ceiling above it, the camera below: the normal's side is half hidden,
// the viewer's is open.
TEST(Side, ViewersSide) {
  TriangleMesh mesh = plane_at(0);
  add_quad(mesh, {-1000, -1000, 1}, {2000, 0, 0}, {0, 2000, 0});
  const Scene scene = of_both_sides({{0.3f, 0.4f, -5}, {0, 0, 0}, {0, 1, 0}, 40});
  const std::vector<Film> films = films_of(scene, mesh);
  for (std::size_t i = 0; i < films[1].pixels(); ++i) EXPECT_EQ(films[1].value(i), 1);
  EXPECT_NEAR(mean_of(films[0]), c * c, 4 * std::sqrt(0.1875 / (64 * 64)));
}

// A plane that is seen at a grazing angle, with vertex normals that lean away from the eye: it is seen from
// above all the same, and a ceiling hides as much of what its normals face.
TEST(Side, ViewersSideIsTheTrianglesNotTheShadingNormals) {
  TriangleMesh mesh = plane_at(0);
  mesh.normals = {glm::normalize(vec3(0.8f, 0, 0.6f))};
  mesh.triangle_normals.assign(mesh.triangles.size(), {0, 0, 0});
  add_quad(mesh, {-1000, -1000, 1}, {2000, 0, 0}, {0, 2000, 0});
  mesh.triangle_normals.resize(mesh.triangles.size(),
                               {TriangleMesh::no_normal, TriangleMesh::no_normal, TriangleMesh::no_normal});
  const Scene scene = of_both_sides({{-3, 0, 0.5f}, {0, 0, 0}, {0, 0, 1}, 10});
  const std::vector<Film> films = films_of(scene, mesh);
  EXPECT_EQ(films[0].hits, std::vector<std::uint32_t>(64, scene.spp));
  EXPECT_EQ(films[1].sum, films[0].sum);
  EXPECT_GT(films[0].value(0), 0);
  EXPECT_LT(films[0].value(0), 1);
}

}  // namespace
}  // namespace nook::test
