// Closed forms on meshes, through the kernels that renders use: estimates at points, their standard errors,
// and the cases that must be exact to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "points/points.hpp"
#include "render/point_estimates.hpp"
#include "support/estimates.hpp"
#include "support/meshes.hpp"
#include "support/program.hpp"
#include "support/rendering.hpp"
#include "support/statistics.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {
namespace {

Scene scene_of(EffectKind kind, Sampling sampling, Sampler sampler, float limit, float exponent = 0) {
  Scene scene;
  scene.sampler = sampler;
  scene.seed = test_seed(51);
  scene.spp = 1;
  Effect effect;
  effect.kind = kind;
  effect.sampling = sampling;
  effect.exponent = exponent;
  if (limit > 0)
    effect.max_distance = {DistanceLimit::Kind::value, limit};
  else
    effect.max_distance.kind = DistanceLimit::Kind::none;
  scene.effects = {effect};
  return scene;
}

// A mesh about a receiver at the origin with normal +z that stands on a floor; `value` is its AO.
struct PolygonCase {
  std::string name;
  TriangleMesh mesh;
  float limit;  // 0: none
  double value;
};

std::vector<PolygonCase> polygon_cases() {
  std::vector<PolygonCase> cases;
  auto add = [&](const std::string& name, float limit, double value) -> TriangleMesh& {
    cases.push_back({name, {}, limit, value});
    add_quad(cases.back().mesh, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    return cases.back().mesh;
  };
  add_quad(add("wall 2 x 1 at distance 1/2", 0, 0.7514621801700255), {0.5f, -1, 0}, {0.5f, 1, 0},
           {0.5f, 1, 1}, {0.5f, -1, 1});
  add_quad(add("square overhead", 0, 0.7605435295392265), {-0.5f, -0.5f, 1}, {0.5f, -0.5f, 1},
           {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 1});
  TriangleMesh& cube = add("cube without a lid", 0, 0.2394564704607735);
  for (float side : {-0.5f, 0.5f}) {
    add_quad(cube, {side, -0.5f, 0}, {side, 0.5f, 0}, {side, 0.5f, 1}, {side, -0.5f, 1});
    add_quad(cube, {-0.5f, side, 0}, {0.5f, side, 0}, {0.5f, side, 1}, {-0.5f, side, 1});
  }
  // Within the limit 2 the ceiling at 1 is a disk of radius sqrt(3): its corners do not matter.
  add_quad(add("ceiling, limit 2", 2, 0.25), {-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1});
  return cases;
}

// The mesh turned, scaled and moved, and the receiver with it.
struct Placement {
  glm::quat rotation{1, 0, 0, 0};
  float scale = 1;
  vec3 offset{0};
  vec3 apply(const vec3& p) const { return scale * (rotation * p) + offset; }
};

TriangleMesh placed(const TriangleMesh& mesh, const Placement& placement) {
  TriangleMesh out = mesh;
  out.bounds = {};
  for (vec3& p : out.positions) out.bounds.add(p = placement.apply(p));
  return out;
}

void expect_mean(const Film& film, double expected, double bound, const std::string& what) {
  std::vector<double> values;
  for (std::size_t i = 0; i < film.pixels(); ++i) values.push_back(film.value(i));
  Moments m = moments(std::span<const double>(values));
  EXPECT_LE(std::abs(m.mean - expected), bound * m.mean_error + 1e-6)
      << what << ": " << m.mean << " for " << expected << ", standard error " << m.mean_error;
}

TEST(Points, AmbientOfPolygons) {
  for (const PolygonCase& c : polygon_cases())
    for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
      Renderer renderer(scene_of(EffectKind::ao, sampling, Sampler::independent, c.limit), c.mesh);
      std::vector<SurfacePoint> points(4096, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0)));
      expect_mean(renderer.at_points(points, 256), c.value, 3.5, c.name + ", " + name_of(sampling));
    }
}

// Where floats are coarse or fine the result must not change: scales of 1e-3 and 1e3, far from the origin,
// tilted.
TEST(Points, AmbientDoesNotDependOnPlacement) {
  const glm::quat tilt = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f));
  const Placement placements[] = {
      {tilt, 1, {0, 0, 0}}, {tilt, 1e-3f, {0, 0, 0}}, {tilt, 1e3f, {0, 0, 0}}, {tilt, 1, {100, -50, 30}}};
  const PolygonCase c = polygon_cases()[2];
  for (const Placement& placement : placements) {
    TriangleMesh mesh = placed(c.mesh, placement);
    Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, Sampler::sobol, 0), mesh);
    std::vector<SurfacePoint> points(
        1024, surface_point(placement.apply({0, 0, 0}), placement.rotation * vec3(0, 0, 1), vec3(0)));
    // At 100 units positions are rounded by 4e-6: the value moves by that much times the gradient.
    expect_mean(renderer.at_points(points, 256), c.value, 4.5,
                "scale " + std::to_string(placement.scale) + ", x " + std::to_string(placement.offset.x));
  }
}

TEST(Points, AmbientWithEverySampler) {
  const PolygonCase c = polygon_cases()[0];
  for (Sampler sampler : {Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder})
    for (std::uint32_t directions : {256u, 100u}) {
      std::vector<double> replicates;
      std::vector<SurfacePoint> points(1024, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0)));
      Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, sampler, 0), c.mesh);
      Film film = renderer.at_points(points, directions);
      if (sampler != Sampler::zorder) {
        expect_mean(film, c.value, 4.5, name_of(sampler) + ", " + std::to_string(directions));
        continue;
      }
      // Neighbouring rows of a Z-order continue one point set: their mean is far better than independent
      // rows' would be.
      double mean = 0;
      for (std::size_t i = 0; i < film.pixels(); ++i) mean += film.value(i) / double(film.pixels());
      EXPECT_NEAR(mean, c.value, 1e-3) << directions;  // independent rows of the same size: 8e-4 each way
    }
}

TEST(Points, ReflectionOfAnOpenSkyAboveAFloor) {
  TriangleMesh floor;
  add_quad(floor, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
  for (Sampling sampling : {Sampling::lobe, Sampling::mixture})
    for (float n : {0.0f, 1.0f, 10.0f, 1000.0f, 1e7f}) {
      Renderer renderer(scene_of(EffectKind::ro, sampling, Sampler::independent, 0, n), floor);
      for (float degrees : {0.0f, 60.0f, 85.0f, 90.0f}) {
        double theta = double(degrees) * std::numbers::pi / 180;
        std::vector<SurfacePoint> points(1024,
                                         surface_point({0, 0, 0}, {0, 0, 1}, view_for_mirror_angle(theta)));
        expect_mean(
            renderer.at_points(points, 256), open_reflection(n, theta), 4,
            name_of(sampling) + ", n = " + std::to_string(n) + ", " + std::to_string(degrees) + " degrees");
      }
      EXPECT_EQ(renderer.counters().rejected, 0u);
    }
}

// The wall of height 1 at distance 1 across the mirror direction; 2000 long, what lies beyond is seen under
// 1e-3.
TEST(Points, ReflectionBeforeAWall) {
  const double values[] = {0.57863246963, 0.44056067031, 0.38169243533};
  TriangleMesh wall;
  add_quad(wall, {1, -1000, 0}, {1, 1000, 0}, {1, 1000, 1}, {1, -1000, 1});
  for (int i = 0; i < 3; ++i) {
    float n = std::pow(10.0f, float(i));
    Renderer renderer(scene_of(EffectKind::ro, Sampling::lobe, Sampler::independent, 0, n), wall);
    std::vector<SurfacePoint> points(
        4096, surface_point({0, 0, 0}, {0, 0, 1}, view_for_mirror_angle(std::numbers::pi / 4)));
    expect_mean(renderer.at_points(points, 256), values[i], 3.5, "n = " + std::to_string(n));
  }
}

// The standard error that a film reports is the spread of its estimates: the mean of the reported variances
// against the sample variance of 4096 independent points.
TEST(Points, ReportedErrorsAreTrue) {
  const PolygonCase c = polygon_cases()[0];
  for (Sampling sampling : {Sampling::cosine, Sampling::sphere}) {
    Renderer renderer(scene_of(EffectKind::ao, sampling, Sampler::independent, 0), c.mesh);
    Film film = renderer.at_points(
        std::vector<SurfacePoint>(4096, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0))), 256);
    std::vector<double> values;
    double reported = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      values.push_back(film.value(i));
      reported += film.variance(i) / double(film.pixels());
    }
    Moments m = moments(std::span<const double>(values));
    EXPECT_NEAR(reported / m.variance, 1, 4 * m.variance_error / m.variance) << name_of(sampling);
  }
}

// 95 % intervals of probes and bakes hold the value 93 to 97 times of 100, whatever the sequence.
TEST(Points, IntervalsCoverWithEverySampler) {
  for (const PolygonCase& c : {polygon_cases()[0], polygon_cases()[2]})
    for (const Sampler sampler :
         {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder}) {
      Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, sampler, c.limit), c.mesh);
      const Film film = renderer.with_errors(
          std::vector<SurfacePoint>(4096, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0))), 512);
      double covered = 0;
      for (std::size_t i = 0; i < film.pixels(); ++i)
        covered += std::abs(film.value(i) - c.value) <= 1.96 * standard_error(film, i, 1);
      covered /= double(film.pixels());
      EXPECT_GT(covered, 0.93) << c.name << ", " << name_of(sampler);
      EXPECT_LT(covered, 0.97) << c.name << ", " << name_of(sampler);
    }
}

// Where no ray or every ray is blocked, what remains possible is told, and not 0.
TEST(Points, NoRayThatHitsIsNoCertainty) {
  for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
    TriangleMesh mesh;
    add_quad(mesh, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, sampler, 0), mesh);
    const Film film = renderer.with_errors({surface_point({0, 0, 0}, {0, 0, 1}, vec3(0))}, 512);
    EXPECT_EQ(film.value(0), 1);
    EXPECT_NEAR(standard_error(film, 0, 1), 3 / 1.96 / 512, 1e-5);
  }
}

TEST(Points, ComeFromAFileOrStandardInput) {
  TemporaryFolder folder;
  write_bytes(folder / "mesh.obj", "v -9 0 0\nv 9 0 0\nv 0 9 9\nf 1 2 3\n");
  write_bytes(folder / "points.csv", "px,py,pz,nx,ny,nz\n0,0,1,0,0,1\n0 1 0.5 0 1 0\n");
  ProgramSetting setting;
  setting.folder = folder.path();
  setting.arguments = {"probe", "mesh.obj", "--samples", "64", "--points", "points.csv"};
  const ProgramResult from_file = run_program(NOOK_PROGRAM, setting);
  EXPECT_EQ(from_file.code, 0) << from_file.err;
  EXPECT_EQ(std::count(from_file.out.begin(), from_file.out.end(), '\n'), 3) << from_file.out;
  setting.arguments.back() = "-";
  setting.standard_input = (folder / "points.csv").string();
  EXPECT_EQ(run_program(NOOK_PROGRAM, setting).out, from_file.out);
}

// Furnace: nothing above a floor, and nothing but walls around; not one ray may be wrong.
TEST(Furnace, IsExactToTheBit) {
  TriangleMesh open, closed;
  add_quad(open, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
  add_box(closed, {-1, -1, -1}, {1, 1, 1}, true);
  for (Sampler sampler : {Sampler::independent, Sampler::sobol}) {
    Scene scene = scene_of(EffectKind::ao, Sampling::cosine, sampler, 0);
    scene.width = scene.height = 64;
    scene.spp = 16;
    scene.directions = 4;
    scene.camera = {{0.3f, -1.2f, 2}, {0, 0, 0}, {0, 0, 1}, 30};
    for (double value : Renderer(scene, open).picture().mean) ASSERT_EQ(value, 1.0);
    scene.camera = {{0.3f, -0.8f, 0.5f}, {0, 0.5f, -0.3f}, {0, 0, 1}, 90};
    for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
      scene.effects[0].sampling = sampling;
      for (double value : Renderer(scene, closed).picture().mean) ASSERT_EQ(value, 0.0);
    }
    scene.effects[0] = scene_of(EffectKind::ro, Sampling::lobe, sampler, 0, 300).effects[0];
    for (double value : Renderer(scene, closed).picture().mean) ASSERT_EQ(value, 0.0);
  }
}

}  // namespace
}  // namespace nook::test
