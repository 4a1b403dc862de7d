// Standard errors at points, as probes and bakes tell them: how many of the 95 % intervals hold the value,
// whatever the point sequence and the distribution, also where few samples carry most of the weight.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adaptive/quantiles.hpp"
#include "points/points.hpp"
#include "render/point_estimates.hpp"
#include "support/closed_forms.hpp"
#include "support/estimates.hpp"
#include "support/meshes.hpp"
#include "support/rendering.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

constexpr Sampler samplers[] = {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol,
                                Sampler::zorder};

struct PointCase {
  std::string name;
  TriangleMesh mesh;
  vec3 view{0, 0, 1};
  Effect effect;
  double value = 0;
};

// A wall without an end at x = 1/2, which hides one half of every lobe in the plane along it: by symmetry
// half of what an open sky has.
PointCase beside_a_wall(double exponent, double degrees, Sampling sampling) {
  const double theta = degrees * std::numbers::pi / 180, far = 1e5;
  PointCase c;
  c.name = fmt::format("RO {}, n = {}, {} degrees", name_of(sampling), exponent, degrees);
  add_quad(c.mesh, vec3(0.5, -far, -far), vec3(0.5, far, -far), vec3(0.5, far, far), vec3(0.5, -far, far));
  c.view = vec3(0, -std::sin(theta), std::cos(theta));
  c.effect.kind = EffectKind::ro;
  c.effect.exponent = float(exponent);
  c.effect.sampling = sampling;
  c.effect.max_distance.kind = DistanceLimit::Kind::none;
  c.value = open_reflection(exponent, theta) / 2;
  return c;
}

PointCase below_a_ceiling(double value, Sampling sampling) {
  PointCase c;
  c.name = fmt::format("AO {}, {}", name_of(sampling), value);
  add_quad(c.mesh, {-99, -99, 1}, {99, -99, 1}, {99, 99, 1}, {-99, 99, 1});
  c.effect.sampling = sampling;
  c.effect.max_distance = {DistanceLimit::Kind::value, float(1 / std::sqrt(value))};
  c.value = value;
  return c;
}

struct Held {
  double told = 0;   // with the standard errors that are told
  double plain = 0;  // with the randomisations' spread and Student's quantile alone
};

Held share_held(const PointCase& c, Sampler sampler, std::uint32_t directions) {
  Scene scene;
  scene.sampler = sampler;
  scene.seed = test_seed(51);
  scene.spp = 1;
  scene.effects = {c.effect};
  Renderer renderer(scene, c.mesh);
  constexpr std::size_t points = 4096;
  const Film film = renderer.with_errors(
      std::vector<SurfacePoint>(points, surface_point({0, 0, 0}, {0, 0, 1}, c.view)), directions);
  Held held;
  for (std::size_t i = 0; i < points; ++i) {
    const double error = std::abs(film.value(i) - c.value);
    held.told +=
        (error <= 1.96 * standard_error(film, i, renderer.plan().effects[0].weight_bound)) / double(points);
    held.plain += (error <= student_quantile(0.95, film.replicates[i] - 1) * std::sqrt(film.variance(i))) /
                  double(points);
  }
  if (long_mode())
    fmt::print("| {} | {} | {} | {:.1f} % | {:.1f} % |\n", c.name, name_of(sampler), directions,
               100 * held.told, 100 * held.plain);
  return held;
}

// The share is known to .4 %. Of so many samples at least some count, and some do not.
Held expect_held(const PointCase& c, Sampler sampler, std::uint32_t directions) {
  const Held held = share_held(c, sampler, directions);
  EXPECT_GT(held.told, 0.93) << c.name << ", " << name_of(sampler) << ", " << directions;
  EXPECT_LT(held.told, 0.97) << c.name << ", " << name_of(sampler) << ", " << directions;
  return held;
}

TEST(PointIntervals, HoldForMixtures) {
  for (const Sampler sampler : {Sampler::independent, Sampler::halton, Sampler::sobol})
    expect_held(beside_a_wall(20, 75, Sampling::mixture), sampler, 512);
}

// That this can fail: the spread alone does not know of hits that there might have been.
TEST(PointIntervals, HoldForFewHits) {
  for (const Sampler sampler : {Sampler::independent, Sampler::sobol})
    for (const double value : {.01, .99})
      EXPECT_LT(expect_held(below_a_ceiling(value, Sampling::cosine), sampler, 512).plain, 0.91);
}

// Eleven times the lobe: 45, 13 and 6 hits' worth of 512 or 64 samples.
TEST(PointIntervals, HoldForHeavyWeights) {
  for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
    expect_held(beside_a_wall(20, 10, Sampling::cosine), sampler, 512);
    EXPECT_GT(share_held(beside_a_wall(20, 75, Sampling::cosine), sampler, 512).told, 0.925);
    const Held few = share_held(beside_a_wall(20, 10, Sampling::cosine), sampler, 64);
    EXPECT_GT(few.told, 0.91);
    EXPECT_LT(few.plain, 0.92);
  }
}

// NOOK_TEST_LONG=1 prints the shares.
TEST(PointIntervals, HoldForEverySamplerAndDistribution) {
  if (!long_mode()) GTEST_SKIP() << "takes minutes: NOOK_TEST_LONG=1";
  for (const std::uint32_t directions : {512u, 64u})
    for (const Sampler sampler : samplers) {
      for (const Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere})
        for (const double value : {.01, .1, .5, .9, .99})
          EXPECT_GT(share_held(below_a_ceiling(value, sampling), sampler, directions).told, 0.91);
      for (const Sampling sampling :
           {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere})
        for (const double n : {1., 20., 100.})
          for (const double degrees : {10., 75.})
            EXPECT_GT(share_held(beside_a_wall(n, degrees, sampling), sampler, directions).told, 0.91);
    }
}

}  // namespace
}  // namespace nook::test
