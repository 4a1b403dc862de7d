// Where floats are too coarse for what is of interest, one line says so; elsewhere none does. That the line
// comes before the values go wrong is docs/proportions.py's table.
#include "plan/proportions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/instance.hpp"
#include "points/points.hpp"
#include "support/meshes.hpp"
#include "support/turned.hpp"

namespace nook {
namespace {

using glm::dmat3;

const dmat3 upright(1);

Scene scene_of(DistanceLimit limit, EffectKind kind = EffectKind::ao) {
  Scene scene;
  scene.file = "scene.toml";
  scene.mesh_file = "mesh.obj";
  scene.camera.eye = {0, 1e3, 1e3};
  Effect effect;
  effect.kind = kind;
  effect.max_distance = limit;
  scene.effects = {effect};
  return scene;
}

const DistanceLimit unlimited{DistanceLimit::Kind::none, 0};

DistanceLimit limit_of(float distance) {
  return {DistanceLimit::Kind::value, distance};
}

void add_square(TriangleMesh& mesh, const dmat3& turn, double height, double half) {
  const auto corner = [&](double x, double z) { return vec3(turn * dvec3(x * half, height, z * half)); };
  test::add_quad(mesh, corner(-0.7, -0.7), corner(-0.7, 1.3), corner(1.3, 1.3), corner(1.3, -0.7));
}

TriangleMesh with_bounds(TriangleMesh mesh) {
  mesh.bounds = {};
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle) mesh.bounds.add(mesh.positions[i]);
  return mesh;
}

TriangleMesh ceiling(const dmat3& turn, double extent) {
  TriangleMesh mesh;
  add_square(mesh, turn, 1, extent / 2);
  return with_bounds(mesh);
}

TriangleMesh corridor(const dmat3& turn, double length) {
  TriangleMesh mesh;
  for (const double x : {-1.0, 1.0}) {
    const auto corner = [&](double y, double z) { return vec3(turn * dvec3(x, y, z * length / 2)); };
    test::add_quad(mesh, corner(0, -1), corner(0, 1), corner(1, 1), corner(1, -1));
  }
  return with_bounds(mesh);
}

TriangleMesh on_floor(TriangleMesh mesh, const dmat3& turn, double extent) {
  for (vec3& p : mesh.positions) p = vec3(turn * dvec3(p));
  add_square(mesh, turn, -1, extent / 2);
  return with_bounds(mesh);
}

TriangleMesh box() {
  TriangleMesh mesh;
  test::add_box(mesh, {-1, -1, -1}, {1, 1, 1});
  return mesh;
}

TriangleMesh sphere(unsigned n) {
  TriangleMesh mesh;
  test::add_sphere(mesh, dvec3(0), n, [](unsigned, unsigned) { return 1.0; });
  return mesh;
}

void expect_says(const std::string& warning, const std::string& start, const std::string& what) {
  EXPECT_TRUE(warning.starts_with(start)) << warning;
  EXPECT_NE(warning.find(what), std::string::npos) << warning;
  EXPECT_EQ(warning.find('\n'), std::string::npos);
}

TEST(ProportionsWarning, NamesALimitThatTiltedTrianglesAreTooCoarseFor) {
  const Scene scene = scene_of(limit_of(2));
  for (const double extent : {1e3, 1e4, 1e5})
    EXPECT_EQ(proportions_warning(scene, ceiling(test::turned, extent), false), "") << extent;
  for (const double extent : {1e6, 1e8, 1e12})
    expect_says(proportions_warning(scene, ceiling(test::turned, extent), false), "mesh.obj: triangle ",
                "times as large as the max_distance of ao (2): its corners are too coarse as floats");
  for (const double extent : {1e3, 1e6, 1e9})
    EXPECT_EQ(proportions_warning(scene, ceiling(upright, extent), false), "") << extent;
}

TEST(ProportionsWarning, NamesTheRatio) {
  TriangleMesh mesh;
  test::add_triangle(mesh, {0, 0, 0}, {1 << 20, 1 << 20, 0}, {0, 1 << 20, 1 << 20});
  expect_says(proportions_warning(scene_of(limit_of(0.5f)), with_bounds(mesh), false),
              "mesh.obj: triangle 1 is 2.1e+06 times as large as", "max_distance of ao (0.5)");
}

TEST(ProportionsWarning, KnowsThatNothingIsWrongWithoutAnEffectOrWithALimitOfNothing) {
  const TriangleMesh mesh = ceiling(test::turned, 1e8);
  EXPECT_EQ(proportions_warning(scene_of(limit_of(2), EffectKind::normal), mesh, true), "");
  EXPECT_EQ(proportions_warning(scene_of(limit_of(0)), mesh, false), "");
}

TEST(ProportionsWarning, NamesWallsThatAreAMillionTimesAsLongAsWide) {
  for (const EffectKind kind : {EffectKind::ao, EffectKind::ro}) {
    const Scene scene = scene_of(unlimited, kind);
    EXPECT_EQ(proportions_warning(scene, corridor(upright, 9e5), false), "");
    EXPECT_EQ(proportions_warning(scene, corridor(test::turned, 5e4), false), "");
    for (const dmat3& turn : {upright, test::turned})
      expect_says(proportions_warning(scene, corridor(turn, 2e6), false), "mesh.obj: triangle ",
                  "times as large as it is wide (");
  }
  // One needle among others is usual.
  TriangleMesh mesh = sphere(8);
  test::add_triangle(mesh, {-1, 0, 1}, {1, 0.5f, 1}, {0.1f, 0.275f, 1});
  EXPECT_EQ(proportions_warning(scene_of(unlimited), with_bounds(mesh), false), "");
}

TEST(ProportionsWarning, NamesTheFloorOfAThingThatIsSmallerThanItsRounding) {
  const Scene scene = scene_of(unlimited);
  EXPECT_EQ(proportions_warning(scene, on_floor(box(), test::turned, 5e4), false), "");
  EXPECT_EQ(proportions_warning(scene, on_floor(box(), upright, 1e9), false), "");
  expect_says(proportions_warning(scene, on_floor(box(), test::turned, 2e7), false), "mesh.obj: triangle 1",
              "times as large as the small triangles beside it");
  // The same of many pieces.
  TriangleMesh mesh = box();
  for (vec3& p : mesh.positions) p = vec3(test::turned * dvec3(p));
  const double side = 2e7;
  for (int i = -5; i < 5; ++i)
    for (int k = -5; k < 5; ++k) {
      const auto corner = [&](double x, double z) {
        return vec3(test::turned * dvec3((i + x) * side, -1, (k + z) * side));
      };
      test::add_quad(mesh, corner(-0.3, -0.3), corner(-0.3, 0.7), corner(0.7, 0.7), corner(0.7, -0.3));
    }
  expect_says(proportions_warning(scene, with_bounds(mesh), false), "mesh.obj: triangle ", "beside it");
}

TEST(ProportionsWarning, NamesTheEyeOfAViewerOnly) {
  Scene scene = scene_of(unlimited);
  scene.camera.eye = test::turned * dvec3(0, 0.5, 0);
  const TriangleMesh mesh = ceiling(test::turned, 1e7);
  expect_says(proportions_warning(scene, mesh, true), "mesh.obj: triangle ", "the distance of the eye");
  EXPECT_EQ(proportions_warning(scene, mesh, false), "");
  EXPECT_EQ(proportions_warning(scene, ceiling(test::turned, 1e4), true), "");
  scene.camera.eye = {0, 0.5, 0};
  EXPECT_EQ(proportions_warning(scene, ceiling(upright, 1e7), true), "");
}

TEST(ProportionsWarning, SaysNothingOfUsualGrounds) {
  for (const unsigned n : {8u, 64u, 200u})
    for (const dmat3& turn : {upright, test::turned})
      for (const DistanceLimit limit : {unlimited, limit_of(0.1f), DistanceLimit()}) {
        Scene scene = scene_of(limit);
        scene.camera.eye = turn * dvec3(0, 1, 4);
        EXPECT_EQ(proportions_warning(scene, on_floor(sphere(n), turn, 2000), true), "") << n;
      }
  TriangleMesh mesh = with_bounds(sphere(64));
  append_ground(mesh, -1, 1e7f);
  EXPECT_EQ(proportions_warning(scene_of(DistanceLimit()), mesh, true), "");
  EXPECT_EQ(proportions_warning(scene_of(unlimited), mesh, true), "");
}

TEST(ProportionsWarning, NamesTheGroundAndInstancesByTheirPlaces) {
  TriangleMesh mesh = with_bounds(sphere(8));
  append_ground(mesh, -1, 1e13f);
  expect_says(proportions_warning(scene_of(limit_of(1)), mesh, false), "mesh.obj: the ground is ", "");

  TriangleMesh placed;
  Scene scene = scene_of(limit_of(1));
  scene.instances.emplace_back();
  const std::uint32_t model = append_model(placed, with_bounds(box()), false);
  place_model(placed, model, glm::dmat4(1));
  EXPECT_EQ(proportions_warning(scene, placed, false), "");
  place_model(placed, model, glm::dmat4(1e8 * test::turned));
  expect_says(proportions_warning(scene, placed, false), "scene.toml: triangle ", "the max_distance of ao");
}

TEST(ProportionsWarning, KnowsSsaosOwnLimit) {
  Scene scene = scene_of(unlimited, EffectKind::ssao);
  scene.effects[0].ssao.radius = 0.5f;
  EXPECT_EQ(proportions_warning(scene, ceiling(upright, 4e5), true), "");
  expect_says(proportions_warning(scene, ceiling(upright, 2e6), true), "mesh.obj: triangle ",
              "times as large as the radius of ssao (0.5)");
}

TEST(ProportionsWarning, NamesALimitBelowTheRoundingOfCoordinates) {
  TriangleMesh mesh = box();
  for (vec3& p : mesh.positions) p = 1e4f * p + vec3(1e6f, 2e6f, -3e6f);
  mesh = with_bounds(mesh);
  EXPECT_EQ(proportions_warning(scene_of(limit_of(100)), mesh, false), "");
  expect_says(proportions_warning(scene_of(limit_of(0.5f)), mesh, false), "mesh.obj: triangle ",
              "times as far from (0, 0, 0) as the max_distance of ao (0.5)");
}

TEST(ProportionsWarning, NamesPointsThatAreTooFar) {
  const TriangleMesh mesh = with_bounds(box());
  std::vector<SurfacePoint> points(3, surface_point({0, 2, 0}, {0, 1, 0}, vec3(0)));
  EXPECT_EQ(far_points_warning(scene_of(limit_of(2)), mesh, points, "p.csv"), "");
  points[1] = surface_point({0, 1e8f, 0}, {0, 1, 0}, vec3(0));
  expect_says(far_points_warning(scene_of(limit_of(2)), mesh, points, "p.csv"), "p.csv: point 2 lies 5.0e+07",
              "as the max_distance of ao (2): there floats are too coarse");
  EXPECT_EQ(far_points_warning(scene_of(unlimited), mesh, points, "p.csv"), "");
}

}  // namespace
}  // namespace nook
