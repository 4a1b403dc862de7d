// The study's machinery on estimators whose error is known: pixels with normal errors of variance s²/level, a
// bias, a fixed cost per level.
#include "report/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nook {
namespace {

constexpr std::size_t pixels = 4000;
constexpr double deviation = 0.4;

std::vector<float> truth() {
  std::vector<float> image(pixels);
  for (std::size_t i = 0; i < pixels; ++i) image[i] = 0.1f + 0.8f * float(i) / pixels;
  return image;
}

// power: error ~ level^-power, 1/2 for independent samples.
StudyMethod synthetic(const std::string& name, double bias = 0, double power = 0.5) {
  StudyMethod method;
  method.name = name;
  method.levels = {1, 4, 16, 64};
  method.render = [=](double level, std::uint32_t seed) {
    std::mt19937 random(seed * 7919 + std::uint32_t(level) + std::uint32_t(name.size()) * 104729);
    const double sd = deviation * std::pow(level, -power);
    std::normal_distribution<float> error{float(bias), float(sd)};
    StudyPicture picture;
    picture.image = truth();
    for (float& v : picture.image) v += error(random);
    picture.variance.assign(pixels, float(sd * sd));
    picture.wall_seconds = 1e-6 * level;
    picture.rays = std::uint64_t(level * pixels);
    return picture;
  };
  return method;
}

// A reference that is the truth plus noise of that variance.
StudyReference reference(double variance) {
  StudyReference r{truth(), std::vector<float>(pixels, float(variance)), 0, 0, ""};
  std::mt19937 random(99);
  std::normal_distribution<float> error(0, float(std::sqrt(variance)));
  if (variance > 0)
    for (float& v : r.image) v += error(random);
  return r;
}

Study finished_study(std::vector<StudyMethod> methods, double reference_variance) {
  Study study(std::move(methods), reference(reference_variance), {.seconds = 60});
  EXPECT_TRUE(study.run([](const Study&) { return true; }));
  return study;
}

TEST(Study, StudentQuantiles) {
  EXPECT_NEAR(student_quantile(0.95, 1), 12.7062, 1e-3);
  EXPECT_NEAR(student_quantile(0.95, 4), 2.77645, 1e-4);
  EXPECT_NEAR(student_quantile(0.95, 19), 2.09302, 1e-4);
}

TEST(Study, CheapPointsGetTwentyRuns) {
  const StudyMethod method = synthetic("a");
  EXPECT_EQ(runs_wanted(method, 1), 20u);
  EXPECT_EQ(runs_wanted(method, 64), 4u);
  EXPECT_EQ(runs_wanted(method, 1024), 2u);
}

// The band holds the true RMSE: at 95 %, 4 misses in 32 bands have a probability of 2 %.
TEST(Study, ErrorsAreMeasuredAndBanded) {
  int missed = 0, bands = 0;
  for (int repeat = 0; repeat < 8; ++repeat) {
    const Study study = finished_study({synthetic("name" + std::string(std::size_t(repeat), 'x'))}, 0);
    for (const StudyPoint& point : study.points()) {
      const PointSummary s = summarise(point);
      const double rmse = deviation / std::sqrt(point.level);
      EXPECT_NEAR(s.rmse.value / rmse, 1, 0.03);
      EXPECT_NEAR(s.error_claimed / rmse, 1, 1e-3);
      EXPECT_NEAR(s.covered, 0.95, 0.01);
      EXPECT_NEAR(s.efficiency * rmse * rmse * 1e-6 * point.level, 1, 0.06);
      missed += rmse < s.rmse.low || rmse > s.rmse.high;
      ++bands;
    }
  }
  EXPECT_LE(missed, 4) << "of " << bands;
}

// A reference as noisy as the estimates at level 16 doubles the raw square error there; subtracted, it leaves
// the truth.
TEST(Study, TheReferencesVarianceIsSubtracted) {
  const Study study = finished_study({synthetic("a")}, deviation * deviation / 16);
  for (const StudyPoint& point : study.points())
    EXPECT_NEAR(summarise(point).rmse.value / (deviation / std::sqrt(point.level)), 1, 0.08) << point.level;
}

// Bias shows as such: its square is separated from the noise, and the error stops falling.
TEST(Study, ABiasedEstimatorIsShownAsBiased) {
  const Study study = finished_study({synthetic("honest"), synthetic("biased", 0.05)}, 1e-4);
  for (const StudyPoint& point : study.points()) {
    const double expected = point.method == "biased" ? 0.05 * 0.05 : 0;
    const double noise = deviation * deviation / point.level / std::sqrt(double(pixels) * point.pairs);
    EXPECT_NEAR(point.bias_square, expected,
                5 * noise + 1e-4 * 5 / std::sqrt(double(pixels)) + 0.1 * 0.02 * expected + 2e-5)
        << point.method << point.level;
  }
  const PointSummary dearest = summarise(study.points().back());
  EXPECT_NEAR(dearest.rmse.value, std::hypot(0.05, deviation / 8), 0.002);
  EXPECT_LT(dearest.covered, 0.87);  // its intervals know nothing of the bias: P(|Z + 1| <= 1.96) = .83
}

TEST(Study, SlopesAreFitted) {
  for (const double power : {0.5, 0.75}) {
    const Study study = finished_study({synthetic("a", 0, power)}, 0);
    std::vector<double> x, y;
    for (const StudyPoint& point : study.points()) {
      x.push_back(std::log(point.level));
      y.push_back(std::log(summarise(point).rmse.value));
    }
    const auto fit = fit_line(x, y, std::vector<double>(x.size(), 1.0));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, -power, 0.02);
    EXPECT_LT(fit->slope_error, 0.02);
  }
}

TEST(Study, CostOfAnError) {
  const std::vector<CostPoint> curve = {{1, .4}, {4, .2}, {16, .1}};
  EXPECT_NEAR(cost_of_error(curve, .2)->value, 4, 1e-12);
  EXPECT_NEAR(cost_of_error(curve, .1414213562)->value, 8, 1e-6);
  EXPECT_NEAR(cost_of_error(curve, .05)->value, 64, 1e-9);
  EXPECT_TRUE(cost_of_error(curve, .05)->extrapolated);
  EXPECT_FALSE(cost_of_error(curve, .04));
  const std::vector<CostPoint> floor = {{1, .05}, {4, .05}, {16, .05}};
  EXPECT_FALSE(cost_of_error(floor, .01));
}

// What was measured is not measured again, and the seeds go on where they stopped.
TEST(Study, Resumes) {
  int runs_first = 0, runs_second = 0;
  Study first({synthetic("a")}, reference(0), {.seconds = 60});
  EXPECT_FALSE(first.run([&](const Study&) { return ++runs_first < 30; }));
  Study second({synthetic("a")}, reference(0), {.seconds = 60});
  second.resume(first.points());
  EXPECT_TRUE(second.run([&](const Study&) { return ++runs_second; }));
  EXPECT_EQ(runs_first + runs_second, 20 + 20 + 16 + 4);
  const Study whole = finished_study({synthetic("a")}, 0);
  for (std::size_t p = 0; p < whole.points().size(); ++p) {
    ASSERT_EQ(second.points()[p].runs.size(), whole.points()[p].runs.size());
    for (std::size_t r = 0; r < whole.points()[p].runs.size(); ++r) {
      EXPECT_EQ(second.points()[p].runs[r].seed, whole.points()[p].runs[r].seed);
      EXPECT_EQ(second.points()[p].runs[r].mean_square_error, whole.points()[p].runs[r].mean_square_error);
    }
  }
}

TEST(Study, KeepsToItsBudget) {
  StudyMethod slow = synthetic("slow");
  slow.render = [render = slow.render](double level, std::uint32_t seed) {
    StudyPicture picture = render(level, seed);
    picture.wall_seconds = 1000 * level;  // as it claims: after one run it is known to be too dear
    return picture;
  };
  Study study({slow}, reference(0), {.seconds = 5});
  int runs = 0;
  EXPECT_TRUE(study.run([&](const Study&) { return ++runs < 1000; }));
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(study.methods_without_runs(), 0u);
}

TEST(Study, CountsTheMethodsThatTimeWasTooShortFor) {
  Study study({synthetic("one"), synthetic("two"), synthetic("three")}, reference(0), {.seconds = 60});
  EXPECT_EQ(study.methods_without_runs(), 3u);
  EXPECT_FALSE(study.run([](const Study&) { return false; }));  // after the first run
  EXPECT_EQ(study.methods_without_runs(), 2u);
}

}  // namespace
}  // namespace nook
