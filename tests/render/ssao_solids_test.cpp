// What the accurate quality takes for solid along a pixel's view ray (glsl/solids.frag): parts that pass
// through one another, open sheets, plates thinner than a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ssao/ssao.hpp"
#include "ssao_scenes.hpp"

namespace nook {
namespace {

using Method = SsaoSettings::Method;

constexpr Camera before_the_wall{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40};

TriangleMesh wall() {
  TriangleMesh mesh;
  test::add_quad(mesh, {-10, -10, -5}, {20, 0, 0}, {0, 20, 0});
  return mesh;
}

SsaoPlan accurate(Method method, const TriangleMesh& mesh) {
  SsaoSettings settings;
  settings.method = method;
  settings.quality = SsaoSettings::Quality::accurate;
  settings.radius = 0.5f;
  return plan_ssao(settings, mesh.bounds);
}

// AO of the pixels that show the wall at z = -5, which is farther than the radius from all else: 1.
float darkest_of_the_wall(const TriangleMesh& mesh, const SsaoPlan& plan) {
  const SsaoFrame frame = SsaoRenderer(mesh).render(before_the_wall, plan, 120, 120, {.positions = true});
  float darkest = 2;
  for (std::size_t i = 0; i < frame.occlusion.size(); ++i)
    if (frame.positions[i].z < -4.99f) darkest = std::min(darkest, frame.occlusion[i]);
  return darkest;
}

// A hull, a pipe that leaves it in front, another behind: along a ray ( ( ) ( ) ) with pairs that do not
// belong together.
TEST(SsaoSolids, PartsThatPassThroughOneAnotherHideNothingBehind) {
  TriangleMesh mesh = wall();
  test::add_box_of(mesh, {-0.8f, -0.4f, -1}, {1.6f, 0.8f, 1});
  test::add_box_of(mesh, {-0.5f, -0.6f, -0.3f}, {1, 1.2f, 0.5f});
  test::add_box_of(mesh, {-0.3f, -0.5f, -1.2f}, {0.6f, 1, 0.5f});
  for (const Method method : {Method::gtao, Method::march})
    EXPECT_GT(darkest_of_the_wall(mesh, accurate(method, mesh)), 0.999f) << int(method);
}

TEST(SsaoSolids, AnOpenSheetHidesNothingFarBehind) {
  for (const bool turned : {false, true})
    for (const Method method : {Method::gtao, Method::march}) {
      TriangleMesh mesh = wall();
      if (turned)
        test::add_quad(mesh, {-0.5f, -0.5f, 0}, {0, 1, 0}, {1, 0, 0});
      else
        test::add_quad(mesh, {-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0});
      SsaoPlan plan = accurate(method, mesh);
      EXPECT_GT(darkest_of_the_wall(mesh, plan), 0.999f) << turned << int(method);
      // Two layers know no sheets: without a back face the solid has no end.
      plan.layers = 2;
      EXPECT_LT(darkest_of_the_wall(mesh, plan), 0.95f) << turned << int(method);
    }
}

// Mean AO of the floor within .2 of a plate that stands on it along x = 0, seen from the right.
double mean_beside_the_plate(const TriangleMesh& mesh, const SsaoPlan& plan) {
  const Camera camera{{4, 3, 0}, {0, 0.3f, 0}, {0, 1, 0}, 30};
  const SsaoFrame frame =
      SsaoRenderer(mesh).render(camera, plan, 160, 120, {.positions = true, .normals = true});
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < frame.occlusion.size(); ++i) {
    const vec3 p = frame.positions[i];
    if (frame.normals[i].y < 0.99f || p.y > 0.01f || std::abs(p.z) > 1 || p.x < 0.02f || p.x > 0.2f) continue;
    sum += frame.occlusion[i];
    ++count;
  }
  EXPECT_GT(count, 100);
  return sum / count;
}

TriangleMesh plate(float thickness) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  test::add_box_of(mesh, {-thickness, 0, -2}, {thickness, 1, 4});
  return mesh;
}

TEST(SsaoSolids, APlateThinnerThanAStepOccludesAsAThickOneDoes) {
  const TriangleMesh thin = plate(0.002f), thick = plate(0.5f);
  SsaoPlan plan = accurate(Method::march, thin);
  const double of_thick = mean_beside_the_plate(thick, plan), of_thin = mean_beside_the_plate(thin, plan);
  EXPECT_NEAR(of_thin, of_thick, 0.005);
  // Without a least thickness steps pass through it.
  plan.thickness = 0;
  EXPECT_GT(mean_beside_the_plate(thin, plan), of_thick + 0.05);
}

}  // namespace
}  // namespace nook
