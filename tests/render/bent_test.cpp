// Bent normals and cones against closed forms, and their sums bit for bit.
#include <gtest/gtest.h>

#include "effects_geometry.hpp"
#include "film/bent_cone.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

Effect bent(DistanceLimit limit = {DistanceLimit::Kind::none, 0}) {
  Effect effect;
  effect.kind = EffectKind::bent;
  effect.max_distance = limit;
  return effect;
}

// Nothing in the way: the normal, and a hemisphere. |B| = 2/3.
TEST(BentNormal, OpenIsTheNormal) {
  const BentCone cone = bent_cone(estimate_at_origin(plane_at(-1), bent()), 0);
  EXPECT_NEAR(cone.direction.x, 0, 0.01);
  EXPECT_NEAR(cone.direction.y, 0, 0.01);
  EXPECT_GT(cone.direction.z, 0.9999);
  EXPECT_GT(cone.half_angle, 85);
}

// A wall x = 1 beside the receiver leaves the quarter x < 0. ∫ω cosθ over it is (-2/3, 0, π/3), ∫cosθ is π/2.
TEST(BentNormal, BesideAWallLeansAwayFromIt) {
  TriangleMesh wall;
  add_quad(wall, {1, -2000, 0}, {0, 4000, 0}, {0, 0, 2000});
  const Film film = estimate_at_origin(wall, bent());
  const BentCone cone = bent_cone(film, 0);
  const double length = std::sqrt(4 + M_PI * M_PI);
  EXPECT_NEAR(cone.direction.x, -2 / length, 0.01);
  EXPECT_NEAR(cone.direction.y, 0, 0.01);
  EXPECT_NEAR(cone.direction.z, M_PI / length, 0.01);
  EXPECT_NEAR(film.value(0), 0.5, 0.01);
  const double e = 1.5 * (length / 3) / (M_PI / 2) - 1;
  EXPECT_NEAR(cone.half_angle, std::acos((e + std::sqrt(e * e + 4 * e)) / 2) * 180 / M_PI, 1);
}

// The cone of a cone: a hood that leaves 30 degrees around the normal open, |B| = 2/3 (1 - c³)/(1 - c²).
TEST(BentNormal, AConeIsFoundAgain) {
  Effect effect = bent();
  effect.cone_angle = 30;
  const BentCone cone = bent_cone(estimate_at_origin(plane_at(-1), effect), 0);
  EXPECT_NEAR(cone.half_angle, 30, 0.5);
  EXPECT_GT(cone.direction.z, 0.9999);
}

TEST(BentNormal, ClosedHasNone) {
  const Film film = estimate_at_origin(plane_at(0.001f), bent());
  EXPECT_LT(film.value(0), 1e-3);
  Film empty(1, 1, 1, 1, 1, 3);
  EXPECT_EQ(bent_cone(empty, 0).direction, vec3(0));
}

// Sums are integers: one launch or many, the same bits; and view space is world space, turned.
TEST(BentNormal, SplitRunsHaveTheSameBits) {
  TriangleMesh mesh = plane_at(0);
  add_quad(mesh, {1, -1, 0}, {0, 2, 0}, {0, 0, 2});
  Scene scene;
  scene.camera = {{0.5f, 3, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.width = 24;
  scene.height = 16;
  scene.spp = 8;
  scene.effects = {bent(), bent()};
  scene.effects[1].view_space = true;
  Renderer renderer(scene, mesh);
  OcclusionTracer& tracer = renderer.tracer();
  const Plan& plan = renderer.plan();
  const auto pixels = pixels_in_order(plan.window, plan.width);
  std::vector<Film> whole = tracer.make_films(), split = tracer.make_films();
  tracer.accumulate(pixels, {0, 8}, whole);
  tracer.accumulate(pixels, {5, 3}, split);
  tracer.accumulate(std::span(pixels).first(100), {0, 5}, split);
  tracer.accumulate(std::span(pixels).subspan(100), {0, 5}, split);
  EXPECT_EQ(whole[0].extra, split[0].extra);
  EXPECT_EQ(whole[1].extra, split[1].extra);
  EXPECT_EQ(whole[0].sum, whole[1].sum);
  const CameraParams& camera = plan.camera;
  for (std::size_t i = 0; i < whole[0].pixels(); i += 7) {
    const vec3 world = bent_cone(whole[0], i).direction, view = bent_cone(whole[1], i).direction;
    EXPECT_NEAR(view.x, glm::dot(world, vec3(camera.right[0], camera.right[1], camera.right[2])), 1e-4);
    EXPECT_NEAR(view.z, -glm::dot(world, vec3(camera.forward[0], camera.forward[1], camera.forward[2])),
                1e-4);
  }
}

TEST(BentNormal, ShardsMergeToTheWholePicture) {
  const TemporaryFolder folder;
  const auto scene = write_small_scene(folder, "bent.toml", "[renderer]\ntype = \"bent\"\nspp = 4\n");
  const Image whole = render_with_nook(folder, scene);
  for (const char* shard : {"1/2", "2/2"}) {
    const ProgramResult run =
        run_nook(folder, std::string("render '") + scene.string() + "' --quiet --shard " + shard + " -o '" +
                             (folder / (std::string("part") + shard[0])).string() + "'");
    ASSERT_EQ(run.code, 0) << run.err;
  }
  const ProgramResult merged =
      run_nook(folder, "merge '" + (folder / "part1").string() + "' '" + (folder / "part2").string() +
                           "' -o '" + (folder / "merged.exr").string() + "'");
  ASSERT_EQ(merged.code, 0) << merged.err;
  const Image together = read_exr(folder / "merged.exr");
  for (const char* channel : {"R", "bent.X", "bent.Y", "bent.Z", "bent.cone", "bent.AO"})
    EXPECT_EQ(plane(whole, channel), plane(together, channel)) << channel;
}

}  // namespace
}  // namespace nook::test
