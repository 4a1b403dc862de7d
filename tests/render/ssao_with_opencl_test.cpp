// OpenCL and OpenGL in one process: PoCL and llvmpipe bring the same LLVM, whichever comes first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "ssao/ssao.hpp"
#include "ssao_scenes.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

std::vector<std::uint64_t> trace() {
  const TriangleMesh mesh = test::asymmetric_scene();
  Scene scene;
  scene.camera = test::asymmetric_camera;
  scene.width = 48;
  scene.height = 32;
  scene.directions = 16;
  scene.effects = {Effect{}};
  const Plan plan = make_plan(scene, mesh);
  const Device device(select_device(""));
  const Bvh bvh = build_bvh(mesh);
  OcclusionTracer tracer(device, plan, mesh, bvh);
  std::vector<Film> films = tracer.make_films();
  tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, plan.samples_per_pixel()}, films);
  return films.front().sum;
}

std::vector<float> draw() {
  SsaoSettings settings;
  settings.method = SsaoSettings::Method::march;
  return SsaoRenderer(test::asymmetric_scene()).render(test::asymmetric_camera, settings, 48, 32).occlusion;
}

bool something(const auto& values) {
  return std::any_of(values.begin(), values.end(), [&](auto value) { return value != values.front(); });
}

TEST(SsaoWithOpenClDeathTest, OpenClFirst) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const auto traced = trace();
        const auto drawn = draw();
        const bool same = trace() == traced && draw() == drawn;
        std::exit(same && something(traced) && something(drawn) ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(SsaoWithOpenClDeathTest, OpenGlFirst) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const auto drawn = draw();
        const auto traced = trace();
        const bool same = draw() == drawn && trace() == traced;
        std::exit(same && something(traced) && something(drawn) ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace nook
