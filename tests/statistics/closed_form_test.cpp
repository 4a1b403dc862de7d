// The estimators against closed forms: mean within 3.5 standard errors, variance within 4 of its own, at 2^20
// independent samples; point sets by independent replicates, within 4.5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/estimates.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

constexpr double pi = std::numbers::pi;
const Sampling ambient_samplings[] = {Sampling::cosine, Sampling::hemisphere, Sampling::sphere};
const Sampling reflection_samplings[] = {Sampling::lobe, Sampling::mixture, Sampling::cosine,
                                         Sampling::hemisphere, Sampling::sphere};

std::uint32_t pixel_count() {
  return long_mode() ? 1 << 16 : 1 << 12;
}  // of 256 directions

EstimatedScene scene_of(const AmbientCase& c) {
  return {c.shape, c.size, c.limit, 0, {0, 0, 1}, 0};
}

// In families of a hundred tests 3.5 standard errors happen; 4.5 is Sidak's bound for 1e-3 of the family.
constexpr double family_bound = 4.5;

void expect_mean(const Moments& m, double expected, const std::string& what, double bound = 3.5) {
  // Below float's rounding of a weight (2^-22, say) a difference is not the estimator's.
  EXPECT_LE(std::abs(m.mean - expected), bound * m.mean_error + 0x1p-22 * expected)
      << what << ": " << m.mean << " for " << expected << ", standard error " << m.mean_error;
}

TEST(ClosedForm, AmbientMeanAndVariance) {
  for (Sampling sampling : ambient_samplings) {
    Estimator estimator({EffectKind::ao, sampling, Sampler::independent});
    for (const AmbientCase& c : ambient_cases()) {
      std::vector<float> values = estimator.samples(scene_of(c), pixel_count(), 1, 256, test_seed(1));
      Moments m = moments(std::span<const float>(values));
      std::string what = c.name + ", " + name_of(sampling);
      expect_mean(m, c.value, what);
      if (sampling == Sampling::cosine || c.cosine_moment > 0) {
        // The tabulated variances have five digits.
        EXPECT_LE(std::abs(m.variance - c.variance(sampling)), 4 * m.variance_error + 1e-5)
            << what << ": variance " << m.variance << " for " << c.variance(sampling);
      }
    }
  }
}

TEST(ClosedForm, AmbientIsOneToTheBitUnderAnOpenSky) {
  for (Sampler sampler : {Sampler::independent, Sampler::sobol}) {
    Estimator estimator({EffectKind::ao, Sampling::cosine, sampler});
    for (float value : estimator.samples(EstimatedScene(), 4096, 1, 64, 3)) ASSERT_EQ(value, 1.0f);
  }
}

// Every point set with every distribution, for counts that are powers of two and that are not, over camera
// samples too.
TEST(ClosedForm, AmbientWithEverySampler) {
  const AmbientCase& c = ambient_cases()[3];
  for (Sampler sampler :
       {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder})
    for (Sampling sampling : ambient_samplings) {
      Estimator estimator({EffectKind::ao, sampling, sampler});
      for (auto [samples, directions] :
           {std::pair{1u, 64u}, {16u, 4u}, {64u, 1u}, {1u, 7u}, {3u, 5u}, {1u, 1u}}) {
        // Z-order pixels of one seed repel: whole images are the replicates.
        std::vector<double> replicates;
        if (sampler == Sampler::zorder) {
          for (std::uint32_t k = 0; k < 64; ++k) {
            double sum = 0;
            for (double mean :
                 estimator.pixel_means(scene_of(c), 256, samples, directions, test_seed(100) + k))
              sum += mean;
            replicates.push_back(sum / 256);
          }
        } else {
          replicates = estimator.pixel_means(scene_of(c), 4096, samples, directions, test_seed(2));
        }
        expect_mean(moments(std::span<const double>(replicates)), c.value,
                    name_of(sampler) + ", " + name_of(sampling) + ", " + std::to_string(samples) + "x" +
                        std::to_string(directions),
                    family_bound);
      }
    }
}

TEST(ClosedForm, FormulasReproduceKnownValues) {
  EXPECT_NEAR(ambient_cases()[3].value, 0.7514621801700255, 1e-14);
  EXPECT_NEAR(ambient_cases()[6].value, 0.7605435295392265, 1e-14);
  EXPECT_NEAR(open_reflection(2, pi / 3), 9.0 / 16, 1e-14);
  EXPECT_NEAR(open_reflection(0, 1.0), (1 + std::cos(1.0)) / 2, 1e-14);
  EXPECT_NEAR(open_reflection(1, pi / 2), 1 / pi, 1e-12);
  EXPECT_NEAR(open_reflection(10, 75 * pi / 180), 0.29190101517, 1e-10);
  EXPECT_NEAR(open_reflection(100, 85 * pi / 180), 0.09761336043, 1e-10);
  EXPECT_NEAR(open_reflection_variance(Sampling::lobe, 10, 0), 1.0 / (11 * 13), 1e-6);
  EXPECT_NEAR(open_reflection_variance(Sampling::cosine, 10, 0), 100.0 / 44, 1e-12);
}

TEST(ClosedForm, ReflectionOfAnOpenSky) {
  for (Sampling sampling : reflection_samplings) {
    Estimator estimator({EffectKind::ro, sampling, Sampler::independent});
    bool renders = sampling == Sampling::lobe || sampling == Sampling::mixture;  // the others only validate
    for (float n : renders ? std::vector<float>{0, 1, 2, 10, 100} : std::vector<float>{1, 10})
      for (double degrees : {0.0, 45.0, 75.0, 85.0, 90.0, 100.0}) {
        double theta = degrees * pi / 180;
        EstimatedScene scene;
        scene.exponent = n;
        scene.view = view_for_mirror_angle(theta);
        std::vector<float> values = estimator.samples(scene, pixel_count(), 1, 256, test_seed(3));
        Moments m = moments(std::span<const float>(values));
        std::string what = name_of(sampling) + ", n = " + std::to_string(int(n)) + ", " +
                           std::to_string(int(degrees)) + " degrees";
        expect_mean(m, open_reflection(n, theta), what);
        double expected = open_reflection_variance(sampling, n, theta);
        EXPECT_LE(std::abs(m.variance - expected), 4 * m.variance_error + 2e-4 * expected + 3e-6)
            << what << ": variance " << m.variance << " for " << expected;
      }
  }
}

// Exponents and views where naive forms lose their digits: no NaN, and still the closed form.
TEST(ClosedForm, ReflectionAtExtremeExponentsAndGrazingViews) {
  for (Sampling sampling : {Sampling::lobe, Sampling::mixture}) {
    Estimator estimator({EffectKind::ro, sampling, Sampler::independent});
    for (float n : {0.0f, 300.0f, 1e3f, 1e5f, 1e7f})
      for (double degrees : {0.0, 60.0, 85.0, 89.9, 90.0, 90.1, 180.0}) {
        double theta = degrees * pi / 180;
        EstimatedScene scene;
        scene.exponent = n;
        scene.view = view_for_mirror_angle(theta);
        std::vector<float> values = estimator.samples(scene, pixel_count(), 1, 64, test_seed(4));
        for (float value : values) ASSERT_TRUE(std::isfinite(value) && value >= 0 && value <= 2);
        // The view's rounding to float moves the mirror direction by about 1e-7 radians.
        Moments m = moments(std::span<const float>(values));
        EXPECT_LE(std::abs(m.mean - open_reflection(n, theta)), 3.5 * m.mean_error + 3e-7)
            << name_of(sampling) << ", n = " << n << ", " << degrees << " degrees: " << m.mean << " for "
            << open_reflection(n, theta);
      }
  }
}

TEST(ClosedForm, ReflectionWithOccluders) {
  for (Sampling sampling : reflection_samplings) {
    Estimator estimator({EffectKind::ro, sampling, Sampler::independent});
    for (const ReflectionCase& c : occluded_reflection_cases()) {
      EstimatedScene scene{
          c.shape, c.size, std::numeric_limits<float>::infinity(), c.exponent, view_for_mirror_angle(c.theta),
          0};
      std::vector<float> values = estimator.samples(scene, pixel_count(), 1, 256, test_seed(5));
      expect_mean(moments(std::span<const float>(values)), c.value,
                  c.name + ", " + name_of(sampling) + ", n = " + std::to_string(int(c.exponent)));
    }
  }
}

TEST(ClosedForm, ReflectionWithEverySampler) {
  const ReflectionCase& c = occluded_reflection_cases()[2];
  EstimatedScene scene{
      c.shape, c.size, std::numeric_limits<float>::infinity(), c.exponent, view_for_mirror_angle(c.theta), 0};
  for (Sampler sampler : {Sampler::stratified, Sampler::halton, Sampler::sobol})
    for (Sampling sampling : {Sampling::lobe, Sampling::mixture})
      for (auto [samples, directions] : {std::pair{1u, 64u}, {8u, 8u}, {1u, 13u}}) {
        Estimator estimator({EffectKind::ro, sampling, sampler});
        std::vector<double> means = estimator.pixel_means(scene, 4096, samples, directions, test_seed(6));
        expect_mean(moments(std::span<const double>(means)), c.value,
                    name_of(sampler) + ", " + name_of(sampling), family_bound);
      }
}

}  // namespace
}  // namespace nook::test
