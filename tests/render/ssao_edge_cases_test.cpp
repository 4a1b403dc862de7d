#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>

#include "ssao/ssao.hpp"
#include "ssao_scenes.hpp"
#include "support/expect_error.hpp"

namespace nook {
namespace {

void expect_all(const std::vector<float>& values, float expected) {
  for (const float value : values) ASSERT_EQ(value, expected);
}

TEST(SsaoEdgeCases, EmptyViewIsBlackAndUncovered) {
  const Camera away{{0, 1, 3}, {0, 1, 9}, {0, 1, 0}, 30};
  for (const auto method :
       {SsaoSettings::Method::point, SsaoSettings::Method::gtao, SsaoSettings::Method::march}) {
    SsaoSettings settings;
    settings.method = method;
    SsaoRenderer renderer(test::asymmetric_scene());
    const SsaoFrame frame = renderer.render(away, settings, 33, 21, {.positions = true, .normals = true});
    expect_all(frame.occlusion, 0);
    expect_all(frame.coverage, 0);
    for (const vec3& p : frame.positions) ASSERT_EQ(p, vec3(0));
    for (const vec3& n : frame.normals) ASSERT_EQ(n, vec3(0));
  }
}

TEST(SsaoEdgeCases, MeshWithoutTrianglesIsBlack) {
  const SsaoFrame frame = SsaoRenderer(TriangleMesh{}).render({}, SsaoSettings{}, 8, 8);
  expect_all(frame.occlusion, 0);
}

TEST(SsaoEdgeCases, OnePixelAndThinImages) {
  SsaoRenderer renderer(test::asymmetric_scene());
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}, {3, 2}}) {
    const SsaoFrame frame = renderer.render(test::asymmetric_camera, SsaoSettings{}, width, height);
    ASSERT_EQ(frame.occlusion.size(), std::size_t(width) * std::size_t(height));
    for (const float value : frame.occlusion) ASSERT_TRUE(value >= 0 && value <= 2) << value;
  }
}

TEST(SsaoEdgeCases, FramesRepeatToTheBit) {
  SsaoRenderer renderer(test::asymmetric_scene());
  const SsaoFrame first = renderer.render(test::asymmetric_camera, SsaoSettings{}, 160, 120);
  renderer.render(test::asymmetric_camera, SsaoSettings{}, 64, 64);
  EXPECT_EQ(renderer.render(test::asymmetric_camera, SsaoSettings{}, 160, 120).occlusion, first.occlusion);
  EXPECT_EQ(SsaoRenderer(test::asymmetric_scene())
                .render(test::asymmetric_camera, SsaoSettings{}, 160, 120)
                .occlusion,
            first.occlusion);
}

TEST(SsaoEdgeCases, RefusesAnImageBeyondTheDevicesSize) {
  SsaoRenderer renderer(test::asymmetric_scene());
  test::expect_error(ErrorKind::device, "does not fit",
                     [&] { renderer.render(test::asymmetric_camera, SsaoSettings{}, 100000, 1); });
}

std::string fingerprint(const std::vector<float>& values) {
  return std::to_string(std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)}));
}

// Mesa reads the variable when its first context is made: the death test's process must not have made one
// before, so the picture of the parent, which it is compared with, travels in the environment.
TEST(SsaoEdgeCasesDeathTest, DrawsTheSameWithoutWorkerThreads) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto draw = [] {
    return fingerprint(SsaoRenderer(test::asymmetric_scene())
                           .render(test::asymmetric_camera, SsaoSettings{}, 64, 48)
                           .occlusion);
  };
  const char* const expected = "NOOK_TEST_EXPECTED";
  if (!std::getenv(expected)) setenv(expected, draw().c_str(), 1);
  EXPECT_EXIT(
      {
        setenv("LP_NUM_THREADS", "0", 1);
        std::exit(draw() == std::getenv(expected) ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
  unsetenv(expected);
}

}  // namespace
}  // namespace nook
