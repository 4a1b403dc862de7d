// The study's efficiency table against theory. Under a ceiling at height 1 with rays of length r, rays closer
// to the normal than cos θ = √A, A = 1/r², are blocked: AO is A and M = E[V cos θ] = 2/3 A^(3/2). RO's
// integrals are taken over the rest of the hemisphere, or over all of it where rays do not reach the ceiling.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>

#include "mesh/obj_loader.hpp"
#include "report/study_methods.hpp"
#include "support/ceiling.hpp"
#include "support/kernels.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

class StudyTheory : public ::testing::Test {
 protected:
  void SetUp() override {
    test::write_floor_and_ceiling(folder_.path() / "ceiling.obj");
    mesh_ = load_obj(folder_.path() / "ceiling.obj");
    bvh_ = build_bvh(mesh_);
  }

  // Studies independent samples of all `samplings`; every point's mean square error, and each prediction,
  // must be the variance expected: the former within three standard errors over the runs, the latter within
  // `prediction_tolerance`, relative.
  void check(const Scene& scene, const std::map<Sampling, double>& variance, double prediction_tolerance) {
    const StudyScene studied(test::device(), scene, mesh_, bvh_, 64, 64);
    StudyChoice choice;
    choice.samplers = {Sampler::independent};
    for (const auto& [sampling, expected] : variance) choice.samplings.push_back(sampling);
    choice.max_spp = 16;
    choice.adaptive = choice.ssao = false;
    Study study(studied.methods(choice), studied.reference(0.5), {.seconds = 60, .seed = 3});
    EXPECT_TRUE(study.run([](const Study&) { return true; }));
    std::size_t m = 0;
    for (const auto& [sampling, expected] : variance) {
      const StudyMethod& method = study.methods()[m++];
      EXPECT_NEAR(method.predicted_variance / expected, 1, prediction_tolerance) << method.name;
      EXPECT_FALSE(method.prediction.empty());
      for (const StudyPoint& point : study.points()) {
        if (point.method != method.name) continue;
        EXPECT_GE(point.runs.size(), 16u);
        double mean = 0, square = 0;
        for (const StudyRun& run : point.runs) mean += run.mean_square_error / double(point.runs.size());
        for (const StudyRun& run : point.runs) square += std::pow(run.mean_square_error - mean, 2);
        const double runs = double(point.runs.size()), deviation = std::sqrt(square / (runs - 1) / runs);
        EXPECT_NEAR(mean * point.level, expected, 3 * deviation * point.level) << method.name << point.level;
        const PointSummary s = summarise(point);
        EXPECT_NEAR(s.efficiency * s.wall_seconds * mean, 1, 1e-9);
      }
    }
  }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_;
  Bvh bvh_;
};

// Integrals over the hemisphere of N = z where cos θ < `below`, by the midpoint rule: 1/2π ∫ f(r·ω, N·ω) dω,
// the mirror direction r at `angle` to N.
template <class F>
double mean_over_visible(double angle, double below, F f) {
  constexpr int steps = 600;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double z = (i + 0.5) / steps * below, s = std::sqrt(1 - z * z);
    for (int j = 0; j < steps; ++j) {
      const double phi = (j + 0.5) / steps * std::numbers::pi;  // the other half is its mirror image
      const double mirror = std::sin(angle) * s * std::cos(phi) + std::cos(angle) * z;
      if (mirror > 0) sum += f(mirror, z);
    }
  }
  return sum * below / steps / steps;
}

// E[w² V] - RO² with the weights of kernels/effect/reflection.cl and the densities of kernels/sample/warp.cl,
// nothing cancelled.
std::map<Sampling, double> reflection_variances(double n, double angle, double below) {
  const double pi = std::numbers::pi;
  const double c = n * n * n / (1 + n * n * n);
  const std::map<Sampling, std::function<double(double, double)>> densities = {
      {Sampling::lobe, [&](double m, double) { return (n + 1) / (2 * pi) * std::pow(m, n); }},
      {Sampling::mixture,
       [&](double m, double z) { return c * (n + 1) / (2 * pi) * std::pow(m, n) + (1 - c) * z / pi; }},
      {Sampling::cosine, [&](double, double z) { return z / pi; }},
      {Sampling::hemisphere, [&](double, double) { return 1 / (2 * pi); }},
      {Sampling::sphere, [&](double, double) { return 1 / (4 * pi); }}};
  const auto integrand = [&](double m, double z) { return (n + 2) / (2 * pi) * std::pow(m, n) * z; };
  const double value = 2 * pi * mean_over_visible(angle, below, integrand);
  std::map<Sampling, double> variances;
  for (const auto& [sampling, density] : densities)
    variances[sampling] = 2 * pi *
                              mean_over_visible(angle, below,
                                                [&](double m, double z) {
                                                  return std::pow(integrand(m, z), 2) / density(m, z);
                                                }) -
                          value * value;
  return variances;
}

TEST_F(StudyTheory, MeasuredVariancesOfAmbientOcclusionAreThoseOfTheFormulas) {
  const double value = .3, m = 2. / 3 * std::pow(value, 1.5);
  Scene scene;
  scene.camera = {{0, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 1}, 40};
  scene.effects = {Effect{}};
  scene.effects.front().max_distance = {DistanceLimit::Kind::value, float(1 / std::sqrt(value))};
  // From 256 samples of 4096 pixels, a standard error of .2 % at the most skewed.
  check(scene,
        {{Sampling::cosine, value - value * value},
         {Sampling::hemisphere, 2 * m - value * value},
         {Sampling::sphere, 4 * m - value * value}},
        .01);
}

// Through an angle so narrow that all pixels look in one direction.
TEST_F(StudyTheory, MeasuredVariancesOfReflectionOcclusionAreThoseOfTheFormulas) {
  for (const auto& [exponent, degrees, value] :
       {std::tuple{1.0, 60.0, 1.0}, std::tuple{5.0, 45.0, .5}, std::tuple{10.0, 60.0, .3}}) {
    SCOPED_TRACE(exponent);
    const double angle = degrees * std::numbers::pi / 180;
    Scene scene;
    scene.camera = {{float(-0.9 * std::tan(angle)), 0.9f, 0}, {0, 0, 0}, {0, 0, 1}, 0.01f};
    scene.effects = {Effect{}};
    scene.effects.front().kind = EffectKind::ro;
    scene.effects.front().sampling = Sampling::lobe;
    scene.effects.front().exponent = float(exponent);
    // At 1 the ray ends at the ceiling itself; a little less, so that no ray reaches it.
    scene.effects.front().max_distance = {DistanceLimit::Kind::value,
                                          value == 1 ? 0.5f : float(1 / std::sqrt(value))};
    check(scene, reflection_variances(exponent, angle, std::sqrt(value)), .015);
  }
}

}  // namespace
}  // namespace nook
