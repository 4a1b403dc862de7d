// The methods against the truth: ray-traced AO with the same radius, weighting and normals, by exact brute
// force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ssao/ssao.hpp"
#include "ssao_scenes.hpp"

namespace nook {
namespace {

using Method = SsaoSettings::Method;
using Quality = SsaoSettings::Quality;
constexpr float radius = 0.5f;

struct Truth {
  std::size_t pixel;
  double ambient;
};

// Cosine-weighted AO at every 13th pixel's hit, 16x16 stratified directions: a standard error below .03 a
// pixel and, since errors are independent, 1e-3 for their mean.
std::vector<Truth> trace_truth(const TriangleMesh& mesh, const SsaoFrame& frame) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Truth> truth;
  for (std::size_t i = 0; i < frame.occlusion.size(); i += 13) {
    if (frame.coverage[i] == 0) continue;
    const dvec3 n = frame.normals[i], origin = dvec3(frame.positions[i]) + 1e-4 * n;
    const dvec3 s = glm::normalize(glm::cross(std::abs(n.x) > 0.7 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), n)),
                t = glm::cross(n, s);
    int open = 0;
    for (int k = 0; k < 256; ++k) {
      const double u = (k % 16 + uniform(random)) / 16,
                   phi = 2 * std::acos(-1.0) * (k / 16 + uniform(random)) / 16;
      const dvec3 d = std::sqrt(u) * (std::cos(phi) * s + std::sin(phi) * t) + std::sqrt(1 - u) * n;
      const auto hit = test::cast_exactly(mesh, origin, d);
      open += !hit || glm::length(hit->position - origin) > radius;
    }
    truth.push_back({i, open / 256.0});
  }
  return truth;
}

struct Errors {
  double rmse, bias;
};

Errors compare(const std::vector<Truth>& truth, const std::vector<float>& occlusion) {
  double square = 0, sum = 0;
  for (const Truth& t : truth) {
    const double difference = double(occlusion[t.pixel]) - t.ambient;
    square += difference * difference;
    sum += difference;
  }
  return {std::sqrt(square / double(truth.size())), sum / double(truth.size())};
}

TEST(SsaoMethods, ErrorsAgainstRayTracedAo) {
  const TriangleMesh mesh = test::asymmetric_scene();
  const int width = 240, height = 160;
  SsaoRenderer renderer(mesh);
  SsaoSettings settings;
  settings.radius = radius;
  const SsaoFrame point =
      renderer.render(test::asymmetric_camera, settings, width, height, {.positions = true, .normals = true});
  const std::vector<Truth> truth = trace_truth(mesh, point);
  ASSERT_GT(truth.size(), 1500u);
  const Errors assigned = compare(truth, point.occlusion);
  const auto expect_errors = [&](Method method, Quality quality, double rmse, double bias) {
    settings.method = method;
    settings.quality = quality;
    const Errors errors =
        compare(truth, renderer.render(test::asymmetric_camera, settings, width, height).occlusion);
    EXPECT_LT(errors.rmse, rmse) << int(method) << " " << int(quality);
    EXPECT_LT(std::abs(errors.bias), bias) << int(method) << " " << int(quality);
    EXPECT_LT(errors.rmse, assigned.rmse);
    return errors.rmse;
  };
  EXPECT_GT(assigned.rmse, 0.05);
  expect_errors(Method::point, Quality::real_time, 0.1, 0.05);
  expect_errors(Method::gtao, Quality::real_time, 0.06, 0.03);
  expect_errors(Method::gtao, Quality::accurate, 0.04, 0.02);
  expect_errors(Method::march, Quality::draft, 0.06, 0.02);
  expect_errors(Method::march, Quality::real_time, 0.05, 0.02);
  EXPECT_LT(3 * expect_errors(Method::march, Quality::accurate, 0.03, 0.01), assigned.rmse);
}

// Nothing occludes a plane, however steeply it is seen: tangent planes, not depths, are compared.
TEST(SsaoMethods, TiltedPlaneIsExactlyOne) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
  for (const float height : {5.0f, 0.3f})
    for (const Method method : {Method::gtao, Method::march})
      for (const Quality quality : {Quality::draft, Quality::real_time, Quality::accurate}) {
        SsaoSettings settings;
        settings.method = method;
        settings.quality = quality;
        settings.radius = 0.5f;
        const SsaoFrame frame =
            SsaoRenderer(mesh).render({{0, height, 2}, {0, 0, -1}, {0, 1, 0}, 30}, settings, 81, 47);
        for (std::size_t i = 0; i < frame.occlusion.size(); ++i)
          ASSERT_EQ(frame.occlusion[i], frame.coverage[i]) << int(method) << int(quality) << " pixel " << i;
      }
}

// A thin board far in front of a wall occludes nothing of it: its back layer says where it ends.
TEST(SsaoMethods, NoHaloAroundAThinBoard) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-10, -10, -5}, {20, 0, 0}, {0, 20, 0});
  test::add_box_of(mesh, {-0.5f, -0.5f, -0.05f}, {1, 1, 0.05f});
  for (const Method method : {Method::gtao, Method::march}) {
    SsaoSettings settings;
    settings.method = method;
    settings.quality = Quality::accurate;
    settings.radius = 0.5f;
    const SsaoFrame frame =
        SsaoRenderer(mesh).render({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40}, settings, 120, 120);
    EXPECT_GT(*std::min_element(frame.occlusion.begin(), frame.occlusion.end()), 0.999f);
  }
}

// A guard band sees the occluder beside the image: the border equals the same pixels in the middle of a
// larger image.
TEST(SsaoMethods, GuardBandRemovesTheBorder) {
  const TriangleMesh mesh = test::asymmetric_scene();
  SsaoRenderer renderer(mesh);
  SsaoSettings settings;
  settings.method = Method::march;
  settings.quality = Quality::accurate;
  settings.radius = 0.2f;
  // The same pixels in both: 60 of 180 rows at a third of the tangent.
  Camera camera = test::asymmetric_camera;
  const SsaoFrame wide = renderer.render(camera, settings, 180, 180);
  camera.fov =
      2 * std::atan(std::tan(camera.fov * std::acos(-1.0f) / 360) / 3) * 360 / (2 * std::acos(-1.0f));
  SsaoPlan plan = plan_ssao(settings, mesh.bounds);
  const auto difference = [&](float guard) {
    plan.guard = guard;
    const SsaoFrame inner = renderer.render(camera, plan, 60, 60);
    double square = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x) {
        const double d = double(inner.occlusion[std::size_t(y * 60 + x)]) -
                         double(wide.occlusion[std::size_t((y + 60) * 180 + x + 60)]);
        square += d * d;
      }
    return std::sqrt(square / 3600);
  };
  EXPECT_LT(difference(1.0f), 0.01);
  EXPECT_GT(difference(0), 3 * difference(1.0f));
}

}  // namespace
}  // namespace nook
