// RO on meshes against closed forms, through the kernels that renders use.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "point_cases.hpp"

namespace nook::test {
namespace {

TEST(Reflection, OfAnOpenSkyAboveAFloor) {
  TriangleMesh floor;
  add_quad(floor, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
  for (Sampling sampling : {Sampling::lobe, Sampling::mixture})
    for (float n : {0.0f, 1.0f, 10.0f, 1000.0f, 1e7f}) {
      Renderer renderer(scene_of(EffectKind::ro, sampling, Sampler::independent, 0, n), floor);
      for (float degrees : {0.0f, 60.0f, 85.0f, 90.0f}) {
        double theta = double(degrees) * std::numbers::pi / 180;
        std::vector<SurfacePoint> points(1024,
                                         surface_point({0, 0, 0}, {0, 0, 1}, view_for_mirror_angle(theta)));
        expect_mean(
            renderer.at_points(points, 256), open_reflection(n, theta), 4,
            name_of(sampling) + ", n = " + std::to_string(n) + ", " + std::to_string(degrees) + " degrees");
      }
      EXPECT_EQ(renderer.counters().rejected, 0u);
    }
}

// The wall of height 1 at distance 1 across the mirror direction; 2000 long, what lies beyond is seen under
// 1e-3.
TEST(Reflection, BeforeAWall) {
  const double values[] = {0.57863246963, 0.44056067031, 0.38169243533};
  TriangleMesh wall;
  add_quad(wall, {1, -1000, 0}, {1, 1000, 0}, {1, 1000, 1}, {1, -1000, 1});
  for (int i = 0; i < 3; ++i) {
    float n = std::pow(10.0f, float(i));
    Renderer renderer(scene_of(EffectKind::ro, Sampling::lobe, Sampler::independent, 0, n), wall);
    std::vector<SurfacePoint> points(
        4096, surface_point({0, 0, 0}, {0, 0, 1}, view_for_mirror_angle(std::numbers::pi / 4)));
    expect_mean(renderer.at_points(points, 256), values[i], 3.5, "n = " + std::to_string(n));
  }
}

}  // namespace
}  // namespace nook::test
