// How fast the variance of an estimate falls with its samples, by point set: log-log slopes over independent
// replicates.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support/estimates.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

// Slope of log2 variance over log2 samples, from 16 to 1024 samples as camera samples x directions. 512
// pixels leave each variance uncertain by 6 %, the slope by about 0.02.
double variance_slope(Sampler sampler, const EstimatedScene& scene, bool one_camera_sample) {
  Estimator estimator({EffectKind::ao, Sampling::cosine, sampler});
  std::vector<double> x, y;
  for (std::uint32_t n = 16; n <= 1024; n *= 2) {
    std::vector<double> means = one_camera_sample ? estimator.pixel_means(scene, 512, 1, n, test_seed(31))
                                                  : estimator.pixel_means(scene, 512, n, 1, test_seed(31));
    x.push_back(std::log2(n));
    y.push_back(std::log2(moments(std::span<const double>(means)).variance));
  }
  return fit_line(x, y).slope;
}

TEST(Convergence, SlopesAreInTheirKnownRanges) {
  // Discontinuous visibility: -1 without stratification; jittered strata give -1.5 in two dimensions
  // (Mitchell 1996), scrambled nets the same or somewhat better.
  const EstimatedScene wall{Shape::wall, {1, INFINITY, 1, 0}};
  EXPECT_NEAR(variance_slope(Sampler::independent, wall, true), -1, 0.08);
  EXPECT_LT(variance_slope(Sampler::stratified, wall, true), -1.3);
  EXPECT_LT(variance_slope(Sampler::halton, wall, true), -1.3);
  EXPECT_LT(variance_slope(Sampler::sobol, wall, true), -1.4);
}

TEST(Convergence, JointSobolKeepsItsRateOverPixelAndDirection) {
  // The receiver moves over a footprint of 1 before the wall at distance 1: four dimensions.
  const EstimatedScene moving{Shape::wall, {1, INFINITY, 1, 0}, INFINITY, 0, {0, 0, 1}, 1};
  EXPECT_NEAR(variance_slope(Sampler::independent, moving, false), -1, 0.08);
  EXPECT_LT(variance_slope(Sampler::sobol, moving, false), -1.3);
}

// At equal samples the point sets must at least not lose against independent ones, for any split into camera
// samples and directions.
TEST(Convergence, StratificationLowersTheVariance) {
  const EstimatedScene moving{Shape::wall, {1, INFINITY, 1, 0}, INFINITY, 0, {0, 0, 1}, 1};
  for (auto [samples, directions] : {std::pair{64u, 1u}, {8u, 8u}, {4u, 32u}}) {
    std::map<Sampler, double> variance;
    for (Sampler sampler : {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol}) {
      Estimator estimator({EffectKind::ao, Sampling::cosine, sampler});
      variance[sampler] = moments(std::span<const double>(estimator.pixel_means(moving, 2048, samples,
                                                                                directions, test_seed(32))))
                              .variance;
    }
    EXPECT_LT(variance[Sampler::stratified], 0.7 * variance[Sampler::independent])
        << samples << "x" << directions;
    EXPECT_LT(variance[Sampler::halton], 0.5 * variance[Sampler::independent])
        << samples << "x" << directions;
    EXPECT_LT(variance[Sampler::sobol], 0.4 * variance[Sampler::independent]) << samples << "x" << directions;
  }
}

// Z-order moves the error to high frequencies: averaged over 4 x 4 pixels it all but cancels, while
// independent pixels keep 1/16 of the variance.
TEST(Convergence, ZorderErrorsCancelAmongNeighbours) {
  const EstimatedScene wall{Shape::wall, {1, INFINITY, 1, 0}};
  Estimator estimator({EffectKind::ao, Sampling::cosine, Sampler::zorder});
  std::vector<double> pixels = estimator.pixel_means(wall, 256 * 64, 1, 4, test_seed(33)), blocks(64 * 16);
  for (std::size_t i = 0; i < pixels.size(); ++i) blocks[i / 1024 * 64 + i % 256 / 4] += pixels[i] / 16;
  double of_pixels = moments(std::span<const double>(pixels)).variance,
         of_blocks = moments(std::span<const double>(blocks)).variance;
  EXPECT_LT(of_blocks, of_pixels / 16 / 3);
}

}  // namespace
}  // namespace nook::test
