// Adaptive renders where the answer is known: under a ceiling at height h, occlusion rays of length r from
// the floor see AO = (h/r)², at every pixel (rays steeper than cos θ = h/r are blocked, and these have share
// 1 - (h/r)² of the cosine distribution). Pixels are independent estimates: their mean shows the bias, and
// the share of intervals that hold the value is their coverage.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <fstream>

#include "bvh/bvh.hpp"
#include "mesh/obj_loader.hpp"
#include "render/adaptive.hpp"
#include "render/forecast.hpp"
#include "support/kernels.hpp"
#include "temporary_folder.hpp"

namespace nook {
namespace {

constexpr int side = 32;
constexpr double pixels = side * side;

class CoverageTest : public ::testing::Test {
 protected:
  // The ceiling's half width, 25, is beyond the reach of every ray here.
  void SetUp() override {
    std::ofstream obj(folder_.path() / "ceiling.obj");
    for (const char* height : {"0", "1"})
      obj << "v -25 " << height << " -25\nv 25 " << height << " -25\nv 25 " << height << " 25\nv -25 "
          << height << " 25\n";
    obj << "f 4 3 2 1\nf 5 6 7 8\n";
    obj.close();
    mesh_ = load_obj(folder_.path() / "ceiling.obj");
    bvh_ = build_bvh(mesh_);
  }

  Plan plan(double value, Sampling sampling, const ErrorTarget& target) const {
    Scene scene;
    scene.camera = {{0, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 1}, 40};
    scene.width = scene.height = side;
    scene.seed = 7;
    Effect effect;
    effect.sampling = sampling;
    effect.max_distance = {DistanceLimit::Kind::value, float(1 / std::sqrt(value))};
    scene.effects = {effect};
    return AdaptiveRender::plan_for(make_plan(scene, mesh_), target);
  }

  struct Outcome {
    double bias, covered, error;
  };
  Outcome measure(double value, Sampling sampling, const ErrorTarget& target) const {
    const Plan made = plan(value, sampling, target);
    PathTracer tracer(test::device(), made, mesh_, bvh_);
    const AdaptiveResult result = AdaptiveRender(tracer, made, target).run();
    EXPECT_EQ(result.share_done, 1);
    Outcome out{0, 0, result.error_reached};
    const PixelEstimates& estimates = result.effects.front();
    for (std::size_t i = 0; i < estimates.value.size(); ++i) {
      const double error = double(estimates.value[i]) - value;
      out.bias += error / pixels;
      out.covered += (error * error <= 1.96 * 1.96 * double(estimates.variance[i])) / pixels;
    }
    return out;
  }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_;
  Bvh bvh_;
};

// Four standard deviations of what is measured, once in 16000 runs, on top of what is allowed.
constexpr double z = 4;

TEST_F(CoverageTest, CountsAreUnbiasedAndCovered) {
  for (const double value : {.04, .1, .5, .9}) {
    const Outcome out = measure(value, Sampling::cosine, {.error = .01});
    EXPECT_LE(std::abs(out.bias), .01 * (.1 + z / std::sqrt(pixels))) << value;
    EXPECT_NEAR(out.covered, .95, .02 + z * std::sqrt(.05 * .95 / pixels)) << value;
    EXPECT_LE(out.error, .01) << value;
  }
}

TEST_F(CoverageTest, RareEventsAreUnbiased) {
  for (const double value : {.01, .99}) {
    const Outcome out = measure(value, Sampling::cosine, {.error = .01});
    EXPECT_LE(std::abs(out.bias), .01 * (.1 + z / std::sqrt(pixels))) << value;
    EXPECT_GE(out.covered, .93 - z * std::sqrt(.05 * .95 / pixels)) << value;
  }
}

// Weighted samples (2 cos θ): the rule with a pilot.
TEST_F(CoverageTest, PlannedSamplesAreUnbiasedAndCovered) {
  for (const double value : {.1, .5, .9}) {
    const Outcome out = measure(value, Sampling::hemisphere, {.error = .015});
    EXPECT_LE(std::abs(out.bias), .015 * (.1 + z / std::sqrt(pixels))) << value;
    EXPECT_NEAR(out.covered, .95, .02 + z * std::sqrt(.05 * .95 / pixels)) << value;
    EXPECT_LE(out.error, .015) << value;
  }
}

TEST_F(CoverageTest, SameBitsEveryTime) {
  const ErrorTarget target{.error = .03};
  const Plan made = plan(.5, Sampling::cosine, target);
  PathTracer tracer(test::device(), made, mesh_, bvh_);
  EXPECT_EQ(AdaptiveRender(tracer, made, target).run().effects.front().value,
            AdaptiveRender(tracer, made, target).run().effects.front().value);
}

// The pilot's spp against what the render then takes.
TEST_F(CoverageTest, TheForecastHolds) {
  const ErrorTarget target{.error = .02};
  const Plan made = plan(.5, Sampling::cosine, target);
  PathTracer tracer(test::device(), made, mesh_, bvh_);
  const double asked[] = {.02};
  const Forecast predicted = forecast(tracer, made, target, asked, 0.2);
  const AdaptiveResult result = AdaptiveRender(tracer, made, target).run();
  double samples = 0;
  for (const std::uint32_t n : result.effects.front().samples) samples += n / pixels;
  EXPECT_NEAR(predicted.rows.front().spp / samples, 1, .15);
}

TEST_F(CoverageTest, AMissedTargetIsExitCode5) {
  const std::string render = std::string(NOOK_PROGRAM) + " render " +
                             (folder_.path() / "ceiling.obj").string() + " --quiet --size 64x64 ";
  const auto exit_code = [](const std::string& command) {
    return WEXITSTATUS(std::system((command + " 2>/dev/null").c_str()));
  };
  EXPECT_EQ(exit_code(render + "--error .3"), 0);
  EXPECT_EQ(exit_code(render + "--error .01 --max-spp 64"), 5);
  EXPECT_EQ(exit_code(render + "--time .5"), 0);
  EXPECT_EQ(exit_code(render + "--dry-run"), 2);
}

}  // namespace
}  // namespace nook
