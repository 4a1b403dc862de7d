// The warps of kernels/sample/warp.cl on the device, against double-precision distributions written in other
// coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "device/kernel_source.hpp"
#include "device/warps.hpp"
#include "support/kernels.hpp"
#include "support/mutants.hpp"
#include "support/statistics.hpp"
#include "support/warp_oracle.hpp"

namespace nook::test {
namespace {

struct WarpCase {
  Warp warp;
  float exponent;
  std::string name;
};

const std::vector<WarpCase>& warp_cases() {
  static const std::vector<WarpCase> cases = [] {
    std::vector<WarpCase> all{{Warp::disk, 0, "disk"},
                              {Warp::sphere, 0, "sphere"},
                              {Warp::hemisphere, 0, "hemisphere"},
                              {Warp::cosine_hemisphere, 0, "cosine hemisphere"}};
    for (float exponent : {0.0f, 1.0f, 10.0f, 300.0f, 1e3f, 1e5f, 1e7f})
      all.push_back({Warp::cosine_power, exponent, "cosine power " + std::to_string(int(exponent))});
    return all;
  }();
  return cases;
}

const Warps& product_warps() {
  static const Warps warps(device());
  return warps;
}

// Uniform on the grid of multiples of 2^-24 that samplers produce.
std::vector<vec2> uniform_2d(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<vec2> points(count);
  for (vec2& u : points) u = {float(random() >> 40) * 0x1p-24f, float(random() >> 40) * 0x1p-24f};
  return points;
}

struct Fit {
  double chi2, ks_angle, ks_azimuth;
  double smallest() const { return std::min({chi2, ks_angle, ks_azimuth}); }
};

// P-values of "warps.map sends uniform points to the distribution": if so, the oracle's transform of the
// directions is uniform on the square. Chi-squared on 32 x 32 cells (in that square every cell is expected to
// hold as many, whatever the exponent), Kolmogorov-Smirnov on each axis.
Fit fit_to_oracle(const Warps& warps, const WarpCase& c, std::size_t count, std::uint32_t seed) {
  std::vector<vec3> directions = warps.map(c.warp, uniform_2d(count, seed), c.exponent);
  std::vector<std::uint64_t> cells(32 * 32);
  std::vector<double> angle, azimuth;
  for (const vec3& w : directions) {
    glm::dvec2 p = oracle_cdf(c.warp, dvec3(w), double(c.exponent));
    if (!(p.x >= -1e-6 && p.x <= 1 + 1e-6 && p.y >= 0 && p.y <= 1)) return {0, 0, 0};
    ++cells[32 * std::min(31, std::max(0, int(p.x * 32))) + std::min(31, int(p.y * 32))];
    angle.push_back(p.x);
    azimuth.push_back(p.y);
  }
  return {uniform_counts_p(cells), ks_uniform_p(angle), ks_uniform_p(azimuth)};
}

TEST(Warp, SamplesFollowTheirDistribution) {
  std::size_t count = long_mode() ? 1 << 24 : 1 << 20;
  double alpha = sidak(1e-3, 3 * warp_cases().size());
  for (const WarpCase& c : warp_cases()) {
    Fit fit = fit_to_oracle(product_warps(), c, count, test_seed(20260101));
    EXPECT_GT(fit.chi2, alpha) << c.name;
    EXPECT_GT(fit.ks_angle, alpha) << c.name;
    EXPECT_GT(fit.ks_azimuth, alpha) << c.name;
  }
}

TEST(Warp, DensityEqualsTheDistribution) {
  for (const WarpCase& c : warp_cases()) {
    std::vector<vec3> directions = product_warps().map(c.warp, uniform_2d(1 << 16, 7), c.exponent);
    std::vector<float> pdf = product_warps().pdf(c.warp, directions, c.exponent);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      double expected = oracle_pdf(c.warp, dvec3(directions[i]), double(c.exponent));
      ASSERT_NEAR(pdf[i] / expected, 1, 1e-5) << c.name << " z = " << directions[i].z;
    }
  }
}

// ∫ pdf = E_q[pdf / q] for any density q that covers it; q is a lobe of another exponent, and the expectation
// a midpoint rule.
TEST(Warp, DensityIntegratesToOne) {
  const int angles = 4096, azimuths = 8;
  for (const WarpCase& c : warp_cases()) {
    if (c.warp == Warp::disk) continue;  // a constant on a unit disk
    Warp q = c.warp == Warp::sphere         ? Warp::sphere
             : c.warp == Warp::cosine_power ? Warp::cosine_power
                                            : Warp::hemisphere;
    double q_exponent = double(c.exponent) / 2;
    std::vector<vec3> directions;
    for (int i = 0; i < angles; ++i)
      for (int j = 0; j < azimuths; ++j)
        directions.push_back(
            vec3(oracle_direction(q, {(i + 0.5) / angles, (j + 0.5) / azimuths}, q_exponent)));
    std::vector<float> pdf = product_warps().pdf(c.warp, directions, c.exponent);
    double integral = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
      integral += pdf[i] / oracle_pdf(q, dvec3(directions[i]), q_exponent) / double(directions.size());
    EXPECT_NEAR(integral, 1, 2e-5) << c.name;
  }
}

TEST(Warp, DensityIsZeroOutsideTheRange) {
  std::vector<vec3> below{{0, 0, -1}, {0.6f, 0, -0.8f}, {1, 0, -1e-20f}};
  for (Warp warp : {Warp::hemisphere, Warp::cosine_hemisphere, Warp::cosine_power})
    for (float exponent : {0.0f, 10.0f, 1e7f})
      for (float pdf : product_warps().pdf(warp, below, exponent)) EXPECT_EQ(pdf, 0.0f);
  EXPECT_EQ(product_warps().pdf(Warp::disk, std::vector<vec3>{{1, 0.5f, 0}})[0], 0.0f);
}

TEST(Warp, InverseRoundTrip) {
  std::vector<vec2> points = uniform_2d(1 << 18, 11);
  for (const WarpCase& c : warp_cases()) {
    std::vector<vec3> directions = product_warps().map(c.warp, points, c.exponent);
    std::vector<vec2> back = product_warps().inverse(c.warp, directions, c.exponent);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      worst = std::max(
          {worst, double(std::abs(back[i].x - points[i].x)), double(std::abs(back[i].y - points[i].y))});
    EXPECT_LT(worst, 1e-6) << c.name;
  }
}

// u and v at and about the ends of their range: unit vectors, inside the range, and the inverse stays in the
// square.
TEST(Warp, EdgesOfTheSquare) {
  const float smallest = std::numeric_limits<float>::denorm_min();
  const float ends[] = {0,    smallest,        0x1p-126f,   0x1p-24f, 0.25f, 0.5f - 0x1p-25f,
                        0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f};
  std::vector<vec2> points;
  for (float u : ends)
    for (float v : ends) points.push_back({u, v});
  for (const WarpCase& c : warp_cases()) {
    std::vector<vec3> directions = product_warps().map(c.warp, points, c.exponent);
    std::vector<vec2> back = product_warps().inverse(c.warp, directions, c.exponent);
    std::vector<float> pdf = product_warps().pdf(c.warp, directions, c.exponent);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const vec3& w = directions[i];
      SCOPED_TRACE(c.name + " at " + std::to_string(points[i].x) + ", " + std::to_string(points[i].y));
      if (c.warp != Warp::disk) {
        EXPECT_NEAR(glm::length(dvec3(w)), 1, 3e-7);
      }
      if (c.warp != Warp::disk && c.warp != Warp::sphere) {
        EXPECT_GT(w.z, 0.0f);
      }
      EXPECT_TRUE(std::isfinite(pdf[i]));
      EXPECT_GT(pdf[i], 0.0f);
      EXPECT_TRUE(back[i].x >= 0 && back[i].x < 1 && back[i].y >= 0 && back[i].y < 1);
      EXPECT_NEAR(back[i].x, points[i].x, 1e-6);
      EXPECT_NEAR(back[i].y, points[i].y, 1e-6);
    }
  }
}

// The mean angle from the axis at exponents where 1 - cos² loses every digit: with the chord's small-angle
// form E[theta²] -> 2/(n+1), a lobe that collapses to its axis fails by its whole size.
TEST(Warp, NarrowLobesKeepTheirWidth) {
  for (float exponent : {1e5f, 1e7f}) {
    std::vector<vec3> directions = product_warps().map(Warp::cosine_power, uniform_2d(1 << 20, 13), exponent);
    std::vector<double> squares;
    for (const vec3& w : directions) {
      double s = std::hypot(double(w.x), double(w.y));
      squares.push_back(std::asin(s) * std::asin(s) * (double(exponent) + 1) / 2);
      ASSERT_GT(s, 0.0);
    }
    Moments m = moments(std::span<const double>(squares));
    EXPECT_LT(std::abs(m.mean - 1), 3.5 * m.mean_error + 2 / double(exponent)) << exponent;
  }
}

// A test that could not fail would prove nothing: each mutant of warp.cl must be rejected by the checks
// above.
TEST(WarpMutants, AreRejected) {
  struct Mutation {
    std::string name, find, replace;
    WarpCase judged;
  };
  const WarpCase power10{Warp::cosine_power, 10, "cosine power 10"};
  const std::vector<Mutation> mutations{
      {"lobe sampled with n + 2", "log_one_minus_square(r) / (exponent + 1.0f)",
       "log_one_minus_square(r) / (exponent + 2.0f)", power10},
      {"lobe's sine from 1 - cos²",
       "sqrt(one_minus_cosine * (1.0f + cosine))",
       "sqrt(1.0f - cosine * cosine)",
       {Warp::cosine_power, 1e7f, "cosine power 1e7"}},
      {"hemisphere for cosine",
       "(float3)(r * azimuth.x, r * azimuth.y, sqrt((1.0f - r) * (1.0f + r)))",
       "(float3)(r * sqrt(2.0f - r * r) * azimuth, (1.0f - r) * (1.0f + r))",
       {Warp::cosine_hemisphere, 0, "cosine"}},
      {"shared u and v", "fma(2.0f, u.y, -1.0f)", "fma(2.0f, u.x, -1.0f)", {Warp::sphere, 0, "sphere"}},
      {"polar radius without the root",
       "return fabs(major);",
       "return major * major;",
       {Warp::disk, 0, "disk"}}};
  for (const Mutation& m : mutations) {
    Warps mutant(device(), mutate(kernel_source("sample/warps.cl"), m.find, m.replace));
    EXPECT_LT(fit_to_oracle(mutant, m.judged, 1 << 18, 20260102).smallest(), 1e-6) << m.name << " survived";
    EXPECT_GT(fit_to_oracle(product_warps(), m.judged, 1 << 18, 20260102).smallest(), 1e-4) << m.judged.name;
  }
  // The density's own mutant: an exponent off by one no longer integrates to 1.
  Warps mutant(device(), mutate(kernel_source("sample/warps.cl"), "INV_PI * (exponent + 1.0f)",
                                "INV_PI * (exponent + 2.0f)"));
  vec3 pole(0, 0, 1);
  EXPECT_GT(
      mutant.pdf(Warp::cosine_power, {&pole, 1}, 10)[0] / oracle_pdf(Warp::cosine_power, dvec3(pole), 10),
      1.05);
}

}  // namespace
}  // namespace nook::test
