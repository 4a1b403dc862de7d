#include "ssao/view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/expect_error.hpp"

namespace nook {
namespace {

const Camera oblique{{1.5f, -2, 3}, {0.25f, 0.5f, -1}, {0.3f, 1, 0.1f}, 40};

// x = reconstruct(project(x), depth(x)) wherever x is in front of the eye.
TEST(SsaoView, ReconstructionInvertsProjection) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const float fov : {0.01f, 1.0f, 30.0f, 120.0f, 179.0f})
    for (const auto& [width, height, guard] :
         {std::array{1, 1, 0}, {7, 5, 0}, {641, 479, 33}, {1, 2000, 3}, {1280, 720, 100}})
      for (const float depth : {1e-5f, 1e-2f, 1.0f, 1e3f, 1e6f}) {
        Camera camera = oblique;
        camera.fov = fov;
        const SsaoView view = make_ssao_view(camera, width, height, guard);
        const vec2 q(uniform(random) * float(view.buffer_width()),
                     uniform(random) * float(view.buffer_height()));
        const vec3 x = view.reconstruct(q, depth);
        EXPECT_EQ(x.z, -depth);
        const vec2 back = view.project(x);
        const float tolerance = 1e-6f * float(view.buffer_width() + view.buffer_height());
        EXPECT_NEAR(back.x, q.x, tolerance) << fov << " " << width << "x" << height << " " << depth;
        EXPECT_NEAR(back.y, q.y, tolerance) << fov << " " << width << "x" << height << " " << depth;
      }
}

// The camera rays' pixel centres: px = (2(x+.5)/W-1) aspect tan(fov/2), py = (1-2(y+.5)/H) tan(fov/2),
// looking along -z.
TEST(SsaoView, PixelCentresAreTheCameraRays) {
  const int width = 13, height = 7, guard = 4;
  const double tan_y = std::tan(0.5 * 40 * std::acos(-1.0) / 180), tan_x = tan_y * width / height;
  const SsaoView view = make_ssao_view(oblique, width, height, guard);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const vec3 direction = view.reconstruct(vec2(float(guard + x) + 0.5f, float(guard + y) + 0.5f), 1);
      EXPECT_NEAR(direction.x, (2 * (x + 0.5) / width - 1) * tan_x, 1e-6);
      EXPECT_NEAR(direction.y, (1 - 2 * (y + 0.5) / height) * tan_y, 1e-6);
    }
}

TEST(SsaoView, FrameIsOrthonormalAndLooksAtTheTarget) {
  const SsaoView view = make_ssao_view(oblique, 640, 480, 0);
  const vec3 at = view.to_view(oblique.at);
  EXPECT_NEAR(at.x, 0, 1e-6);
  EXPECT_NEAR(at.y, 0, 1e-6);
  EXPECT_NEAR(at.z, -glm::length(oblique.at - oblique.eye), 1e-5);
  EXPECT_GT(view.to_view(oblique.eye + dvec3(oblique.up)).y, 0);
  const vec3 p(3, -1, 2);
  EXPECT_LT(glm::length(view.to_world(view.to_view(p)) - p), 1e-5f);
}

TEST(SsaoView, RefusesACameraWithoutADirection) {
  test::expect_error(ErrorKind::scene, "same point", [] {
    make_ssao_view({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 30}, 10, 10, 0);
  });
  test::expect_error(ErrorKind::scene, "up", [] {
    make_ssao_view({{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 30}, 10, 10, 0);
  });
}

}  // namespace
}  // namespace nook
