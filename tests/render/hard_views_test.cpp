// Hard cases of docs/hard-cases.md that lie in the camera, the limits and the numbers drawn; each expected
// value is derived where it stands.
#include <numbers>

#include "hard_case.hpp"
#include "support/meshes.hpp"
#include "support/mutants.hpp"

namespace nook::test {
namespace {

class HardViews : public HardCases {};

INSTANTIATE_TEST_SUITE_P(Traversals, HardViews, every_traversal(), traversal_name);

// A distance limit of 0 sees nothing, and so does one far below every size; one beyond the scene is as good
// as none.
TEST_P(HardViews, DistanceLimits) {
  Case box(closed_box(2));
  box.scene.camera = {{0, 0, 0.5f}, {0.2f, 0.1f, -1}, {0, 1, 0}, 60};
  box.scene.spp = 16;
  for (const float limit : {0.0f, 1e-38f, 1e-20f}) {
    box.limit(limit);
    expect_all(box.render(GetParam()), 1);
  }
  for (const float limit : {1e3f, 1e38f, infinity}) {
    box.limit(limit);
    expect_all(box.render(GetParam()), 0);
  }
}

TEST_P(HardViews, ExtremeCamerasSeeAnOpenFloor) {
  Case floor(square(100));
  floor.scene.spp = 4;
  const auto expect_open = [&](const Camera& camera, int width, int height) {
    floor.scene.camera = camera;
    floor.scene.width = width;
    floor.scene.height = height;
    expect_all(floor.render(GetParam()), 1);
  };
  for (const float fov : {0.01f, 30.0f, 179.0f})
    expect_open({{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, fov}, 16, 16);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 60}, 1, 1);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 60}, 1, 20000);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 1}, 20000, 1);
  // The closest that a camera can come: the next float above the floor.
  expect_open({{0.1f, std::numeric_limits<float>::denorm_min(), 0.2f}, {0.1f, -1, 0.2f}, {0, 0, 1}, 60}, 4,
              4);
}

// Exactly on a surface, and inside a wall: whatever is seen has a finite value in [0, 1].
TEST_P(HardViews, CameraOnASurfaceOrInAWall) {
  for (const vec3 eye : {vec3(0.25f, -1, 0.1f), vec3(1, 1, 1), vec3(0.3f, 0.99999994f, 0)}) {
    Case box(closed_box(4));
    box.scene.camera = {eye, {0.1f, 0.2f, 0.3f}, {0, 1, 0}, 90};
    const Film film = box.render(GetParam());
    for (std::size_t i = 0; i < film.pixels(); ++i)
      EXPECT_TRUE(film.value(i) >= 0 && film.value(i) <= 1) << film.value(i);
  }
}

// What is not finite is counted, and adds nothing.
TEST_P(HardViews, NonFinitePointsAreCountedAndKeptOut) {
  const Case box(closed_box(2));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<SurfacePoint> points(3, box.point({0, 0, 0}, {0, 0, 1}));
  points[0].normal[1] = nan;
  points[1].origin[0] = infinity;
  const Film film = box.probe(GetParam(), points, 1000, 2000);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(film.sum[i], 0u);
}

// The least and the greatest numbers that a sampler can return, 0, 2^-24 and 1 - 2^-24, in all pairs, drawn
// by the kernels in place of their random numbers: in a closed box no direction is open, above a floor no ray
// of AO is blocked, and every weight is finite.
TEST_P(HardViews, EndsOfTheSquare) {
  const OcclusionTracer::KernelSource ends = [](const std::string& file) {
    return mutate(kernel_source(file),
                  "      ux[k] = uint_to_unit_float(h.x);\n"
                  "      uy[k] = uint_to_unit_float(h.y);\n",
                  "      const float ends[3] = {0.0f, 0x1p-24f, 1.0f - 0x1p-24f};\n"
                  "      ux[k] = ends[index[k] % 3u];\n"
                  "      uy[k] = ends[index[k] / 3u % 3u];\n");
  };
  Case box(closed_box(2)), floor(square(100));
  box.scene.camera = {{0, 0, 0.5f}, {0.2f, 0.1f, -1}, {0, 1, 0}, 60};
  floor.scene.camera = {{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, 60};
  for (Case* each : {&box, &floor}) each->scene.spp = 9;
  for (const Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    box.scene.effects[0].sampling = sampling;
    expect_all(box.render(GetParam(), ends), 0);
  }
  expect_all(floor.render(GetParam(), ends), 1);
  for (const float exponent : {0.0f, 30.0f, 1e7f})
    for (const Sampling sampling :
         {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
      box.reflect(exponent);
      floor.reflect(exponent);
      box.scene.effects[0].sampling = floor.scene.effects[0].sampling = sampling;
      expect_all(box.render(GetParam(), ends), 0);
      const Film film = floor.render(GetParam(), ends);
      for (std::size_t i = 0; i < film.pixels(); ++i)
        EXPECT_TRUE(film.value(i) >= 0 && std::isfinite(film.value(i))) << film.value(i);
    }
}

// 2^26 samples of one pixel: a float sum would stop at 2^24. The wedge of 60 degrees has AO (1 - 1/2)/2 =
// 0.25.
TEST_P(HardViews, ManySamplesOnOnePixelDoNotDrift) {
  const Case corner(wedge(float(std::numbers::pi / 3), 1e4f));
  constexpr std::uint32_t directions = 1u << 26;
  const Film film = corner.probe(GetParam(), {corner.point({1, 0, 0}, {0, 1, 0})}, directions);
  EXPECT_EQ(film.replicates[0], directions);
  EXPECT_NEAR(film.value(0), 0.25, 5 * std::sqrt(0.1875 / directions) + 1e-4);
  // The variance is that of a frequency, counted without loss.
  EXPECT_NEAR(film.variance(0) * directions, 0.1875, 1e-3);
}

}  // namespace
}  // namespace nook::test
