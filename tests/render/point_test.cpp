// Estimates at points: their standard errors and where points come from; and the cases that must be exact to
// the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "point_cases.hpp"
#include "render/point_estimates.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"
#include "trace/randomisations.hpp"

namespace nook::test {
namespace {

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
TEST(Points, IntervalsHoldWithEverySampler) {
  for (const PolygonCase& c : {polygon_cases()[0], polygon_cases()[2]})
    for (const Sampler sampler :
         {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder}) {
      Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, sampler, c.limit), c.mesh);
      const Film film = renderer.with_errors(
          std::vector<SurfacePoint>(4096, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0))), 512);
      double held = 0;
      for (std::size_t i = 0; i < film.pixels(); ++i)
        held += std::abs(film.value(i) - c.value) <= 1.96 * standard_error(film, i, 1);
      held /= double(film.pixels());
      EXPECT_GT(held, 0.93) << c.name << ", " << name_of(sampler);
      EXPECT_LT(held, 0.97) << c.name << ", " << name_of(sampler);
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
    EXPECT_NEAR(standard_error(film, 0, 1), std::sqrt(2.5) / 512, 1e-5);
  }
}

// Randomisations share launches; each is what a launch of its own with its seed gives, and a point keeps its
// random numbers wherever a list is cut.
TEST(Points, RandomisationsTogetherAreThoseOneByOne) {
  const PolygonCase c = polygon_cases()[0];
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 37; ++i) points.push_back(surface_point({0.01f * float(i), 0, 0}, {0, 0, 1}, vec3(0)));
  for (const EffectKind kind : {EffectKind::ao, EffectKind::bent})
    for (const Sampler sampler : {Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder}) {
      const Scene scene = scene_of(kind, Sampling::cosine, sampler, 0);
      Renderer renderer(scene, c.mesh);
      OcclusionTracer& tracer = renderer.tracer();
      const std::vector<Film> some = tracer.estimate_randomised(std::span(points).subspan(5), 5, 3, 24);
      for (std::uint32_t r = 0; r < 3; ++r) {
        tracer.set_samples(1, Randomisations::seed_of(scene.seed, r));
        const Film alone = std::move(tracer.estimate_all(points, 24).front());
        for (std::size_t i = 5; i < points.size(); ++i) {
          const std::size_t at = r * (points.size() - 5) + i - 5;
          ASSERT_EQ(some.front().sum[at], alone.sum[i]) << name_of(sampler) << ", " << r << ", " << i;
          for (std::size_t plane = 0; plane < alone.extra.size(); ++plane)
            ASSERT_EQ(some.front().extra[plane][at], alone.extra[plane][i]);
        }
        tracer.set_samples(1, scene.seed);
      }
      const auto sums = std::span(some.front().sum).first(2 * (points.size() - 5));
      EXPECT_FALSE(std::ranges::equal(sums.first(sums.size() / 2), sums.last(sums.size() / 2)))
          << name_of(sampler);
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
