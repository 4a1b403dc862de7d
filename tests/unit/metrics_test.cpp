#include "image/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "image/ssim.hpp"

namespace nook {
namespace {

using Plane = std::vector<float>;
constexpr int side = 32;
constexpr std::size_t pixels = side * side;

Plane constant(float value) {
  return Plane(pixels, value);
}

/// value + amplitude and value - amplitude in turns.
Plane alternating(float value, float amplitude) {
  Plane plane(pixels);
  for (std::size_t i = 0; i < pixels; ++i) plane[i] = i % 2 ? value - amplitude : value + amplitude;
  return plane;
}

/// slope * x in every row.
Plane ramp(float slope) {
  Plane plane(pixels);
  for (std::size_t i = 0; i < pixels; ++i) plane[i] = slope * static_cast<float>(i % side);
  return plane;
}

TEST(Metrics, EqualImages) {
  const Metrics m = compare_images(ramp(0.01f), ramp(0.01f), side, side);
  EXPECT_EQ(m.pixels, pixels);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.max_abs, 0);
  EXPECT_EQ(m.rel_mse, 0);
  EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(m.ssim, 1, 1e-12);
  EXPECT_EQ(m.z_score, 0);
}

TEST(Metrics, AConstantDifference) {
  // 0.5 against 0.25: every norm is 0.25; relMSE 0.0625 / (0.0625 + 0.01); PSNR -10 log10(1/16) = 12.041 dB.
  const Metrics m = compare_images(constant(0.5f), constant(0.25f), side, side);
  EXPECT_DOUBLE_EQ(m.rmse, 0.25);
  EXPECT_DOUBLE_EQ(m.mae, 0.25);
  EXPECT_DOUBLE_EQ(m.max_abs, 0.25);
  EXPECT_DOUBLE_EQ(m.mean_difference, 0.25);
  EXPECT_NEAR(m.rel_mse, 0.0625 / 0.0725, 1e-12);
  EXPECT_NEAR(m.psnr, 12.0412, 1e-4);
  EXPECT_EQ(m.z_score, std::numeric_limits<double>::infinity());
}

TEST(Metrics, TheSignIsOfAMinusB) {
  EXPECT_LT(compare_images(constant(0.25f), alternating(0.5f, 0.125f), side, side).z_score, 0);
  EXPECT_LT(compare_images(constant(0.25f), constant(0.5f), side, side).mean_difference, 0);
}

TEST(Metrics, ZScoreOfDifferencesKnown) {
  // Differences 2d and 0 in turns: mean d, sum of squared deviations n d², so the standard error is d /
  // sqrt(n-1).
  const Metrics m = compare_images(alternating(0.625f, 0.125f), constant(0.5f), side, side);
  EXPECT_DOUBLE_EQ(m.mean_difference, 0.125);
  EXPECT_NEAR(m.z_score, std::sqrt(pixels - 1.0), 1e-9);
  EXPECT_NEAR(m.rmse, std::sqrt(0.5) * 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(m.mae, 0.125);
}

TEST(Metrics, TheReferencesOwnNoiseIsSubtracted) {
  // mean((a-b)²) = 1/64; of that 1/256 is the reference's variance: sqrt(3/256).
  const Plane a = constant(0.5f), b = alternating(0.5f, 0.125f);
  EXPECT_NEAR(compare_images(a, b, side, side, constant(1.0f / 256)).rmse_without_reference_noise,
              std::sqrt(3.0 / 256), 1e-12);
  EXPECT_EQ(compare_images(a, b, side, side, constant(0.5f)).rmse_without_reference_noise, 0);
  const Metrics without = compare_images(a, b, side, side);
  EXPECT_EQ(without.rmse_without_reference_noise, without.rmse);
}

TEST(Metrics, ValuesThatAreNotFiniteAreCountedAndLeftOut) {
  Plane a = constant(0.5f), b = constant(0.5f), variance = constant(0);
  a[3] = std::nanf("");
  b[5] = std::numeric_limits<float>::infinity();
  variance[7] = std::nanf("");
  const Metrics m = compare_images(a, b, side, side, variance);
  EXPECT_EQ(m.non_finite, 3u);
  EXPECT_EQ(m.pixels, pixels - 3);
  EXPECT_EQ(m.rmse, 0);
  const Metrics none = compare_images(Plane(1, std::nanf("")), Plane(1, 0.0f), 1, 1);
  EXPECT_EQ(none.pixels, 0u);
  EXPECT_TRUE(std::isnan(none.rmse));
}

constexpr double c1 = 1e-4, c2 = 9e-4;

TEST(Ssim, ConstantImagesDifferInLuminanceAlone) {
  const Plane a = constant(0.5f), b = constant(0.25f);
  EXPECT_NEAR(structural_similarity(a, b, side, side), (2 * 0.125 + c1) / (0.25 + 0.0625 + c1), 1e-9);
}

TEST(Ssim, ARampAgainstItsNegative) {
  // The window is symmetric, so a ramp's mean is its centre value s x, and its variance s² Σ w d² = s² v;
  // against the negative ramp the covariance is minus that. v of the Gaussian cut at +-5 is found by the
  // direct sum.
  double weight = 0, v = 0;
  for (int d = -5; d <= 5; ++d) {
    weight += std::exp(-d * d / 4.5);
    v += d * d * std::exp(-d * d / 4.5);
  }
  v /= weight;
  const double s = 0.0078125;
  double expected = 0;
  for (int x = 5; x < side - 5; ++x) {
    const double mean = s * x;
    expected +=
        (-2 * mean * mean + c1) * (-2 * s * s * v + c2) / ((2 * mean * mean + c1) * (2 * s * s * v + c2));
  }
  expected /= side - 10;
  EXPECT_NEAR(structural_similarity(ramp(static_cast<float>(s)), ramp(static_cast<float>(-s)), side, side),
              expected, 1e-9);
}

TEST(Ssim, WindowsWithANaNAreLeftOut) {
  Plane a = constant(0.5f);
  a[0] = std::nanf("");
  EXPECT_NEAR(structural_similarity(a, constant(0.5f), side, side), 1, 1e-12);
}

TEST(Ssim, UndefinedBelowOneWindow) {
  EXPECT_TRUE(std::isnan(structural_similarity(Plane(100), Plane(100), 10, 10)));
  EXPECT_NEAR(structural_similarity(Plane(121), Plane(121), 11, 11), 1, 1e-12);
}

}  // namespace
}  // namespace nook
