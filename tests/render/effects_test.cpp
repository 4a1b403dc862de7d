// Several effects of one scene, through the program: the bits of each, and what was not simulated, by the
// run's own counters.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "support/nook_program.hpp"

namespace nook::test {
namespace {

const std::string renderer = "[renderer]\nspp = 4\n";

bool maps(const nlohmann::json& stats, const std::string& library) {
  for (const std::string name : stats.at("libraries"))
    if (name.find(library) != std::string::npos) return true;
  return false;
}

nlohmann::json stats_of(const TemporaryFolder& folder, const std::string& rest,
                        const std::string& arguments = "") {
  std::string stats;
  render_with_nook(folder, write_small_scene(folder, "scene.toml", rest), arguments, &stats);
  return nlohmann::json::parse(stats);
}

TEST(Effects, TogetherHaveTheBitsOfEachAlone) {
  const TemporaryFolder folder;
  const std::string near = "type = \"ao\"\nmax_distance = 0.3\n", ro = "type = \"ro\"\nexponent = 5\n",
                    plain = "type = \"ao\"\n";
  const Image together = render_with_nook(
      folder, write_small_scene(folder, "list.toml",
                                renderer + "[[effect]]\n" + plain + "[[effect]]\nname = \"near\"\n" + near +
                                    "[[effect]]\n" + ro +
                                    "[[effect]]\ntype = \"normal\"\n[[effect]]\ntype = \"depth\"\n"));
  const auto alone = [&](const std::string& keys, const std::string& channel) {
    return plane(render_with_nook(folder, write_small_scene(folder, "one.toml", renderer + keys)), channel);
  };
  EXPECT_EQ(plane(together, "R"), alone(plain, "R"));
  EXPECT_EQ(plane(together, "near.R"), alone(near, "R"));
  EXPECT_EQ(plane(together, "ro.R"), alone(ro, "R"));
  EXPECT_EQ(plane(together, "normal.Y"), alone("type = \"normal\"\n", "G"));
  EXPECT_EQ(plane(together, "depth.Z"), alone("type = \"depth\"\n", "R"));
  EXPECT_NE(plane(together, "near.R"), plane(together, "R"));
}

// The floor's normal is (0,1,0), and it lies nearer than the camera's distance to its far corner.
TEST(Effects, NormalAndDepthAreOfTheSurface) {
  const TemporaryFolder folder;
  const Image image = render_with_nook(
      folder,
      write_small_scene(
          folder, "s.toml",
          "[[effect]]\ntype = \"depth\"\n[[effect]]\ntype = \"normal\"\n[[effect]]\ntype = \"position\"\n"));
  const auto depth = plane(image, "R"), y = plane(image, "normal.Y"), height = plane(image, "position.Y");
  int floor = 0, background = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (std::isinf(depth[i])) {
      ++background;
      EXPECT_EQ(y[i], 0);
    } else {
      EXPECT_LT(depth[i], 10);
      EXPECT_GT(depth[i], 2);
    }
    if (y[i] == 1 && std::abs(height[i]) < 1e-4f) ++floor;
  }
  EXPECT_GT(floor, 300);
  EXPECT_GT(background, 100);
}

TEST(Effects, BackgroundTracesNothing) {
  const TemporaryFolder folder;
  const auto hit = stats_of(folder, renderer);
  const auto everywhere = std::uint64_t(48 * 36 * 4);
  EXPECT_EQ(hit["rays"]["camera"], everywhere);
  EXPECT_LT(hit["rays"]["occlusion"].get<std::uint64_t>(), everywhere);
  EXPECT_GT(hit["rays"]["occlusion"].get<std::uint64_t>(), everywhere / 4);
  const auto away = stats_of(folder, renderer, "--crop 0,48,0,2");
  EXPECT_EQ(away["rays"]["occlusion"], 0);
}

// The box alone has a lobe: with it out of the window no ray is traced, and elsewhere the value is 0.
TEST(Effects, SurfacesWithoutALobeTraceNothing) {
  const TemporaryFolder folder;
  const std::string lobes = renderer + "type = \"ro\"\nexponent = \"material\"\n";
  std::string text;
  const Image image =
      render_with_nook(folder, write_small_scene(folder, "m.toml", lobes), "--aov position", &text);
  const Image same = render_with_nook(
      folder, write_small_scene(folder, "s.toml", renderer + "type = \"ro\"\nexponent = 20\n"));
  const auto by_material = plane(image, "R"), constant = plane(same, "R"), x = plane(image, "P.X"),
             height = plane(image, "P.Y"), z = plane(image, "P.Z");
  int boxes = 0;
  for (std::size_t i = 0; i < by_material.size(); ++i) {
    // Inside the box's front face, so that every ray of the pixel meets it.
    if (std::abs(x[i]) < 0.35f && height[i] > 0.15f && height[i] < 0.85f && z[i] > 0.45f && z[i] < 0.55f) {
      EXPECT_EQ(by_material[i], constant[i]);
      ++boxes;
    }
    if (z[i] > 1) {
      EXPECT_EQ(by_material[i], 0);
    }
  }
  EXPECT_GT(boxes, 20);
  const auto floor_only = stats_of(folder, lobes, "--crop 0,10,30,36");
  EXPECT_EQ(floor_only["rays"]["occlusion"], 0);
  EXPECT_GT(stats_of(folder, lobes)["rays"]["occlusion"].get<std::uint64_t>(), 0u);
}

// At exponent 0 half of a lobe about a grazing mirror direction lies under the horizon.
TEST(Effects, DirectionsUnderTheHorizonAreNotTraced) {
  const TemporaryFolder folder;
  const auto wide = stats_of(folder, renderer + "type = \"ro\"\nexponent = 0\n"),
             narrow = stats_of(folder, renderer + "type = \"ro\"\nexponent = 1e6\n");
  const double ratio = wide["rays"]["occlusion"].get<double>() / narrow["rays"]["occlusion"].get<double>();
  EXPECT_LT(ratio, 0.85);
  EXPECT_GT(ratio, 0.5);
}

TEST(Effects, WhatIsPlannedIsUploaded) {
  const TemporaryFolder folder;
  for (const std::string rest :
       {"type = \"ao\"\n", "type = \"ro\"\nexponent = \"material\"\n", "type = \"normal\"\n"}) {
    const auto scene = write_small_scene(folder, "scene.toml", renderer + rest);
    const ProgramResult said = run_nook(folder, "plan --json '" + scene.string() + "'");
    ASSERT_EQ(said.code, 0) << said.err;
    const auto plan = nlohmann::json::parse(said.out);
    std::uint64_t bytes = 0;
    for (const auto& buffer : plan["buffers"]) bytes += buffer["bytes"].get<std::uint64_t>();
    const auto stats = stats_of(folder, renderer + rest);
    EXPECT_EQ(stats["bytes_uploaded"], bytes) << rest;
    EXPECT_EQ(stats["kernels_built"], plan["kernels"].size()) << rest;
  }
}

TEST(Effects, OfflineMapsNoOpenGl) {
  const TemporaryFolder folder;
  const auto stats = stats_of(folder, renderer);
  EXPECT_TRUE(maps(stats, "OpenCL"));
  EXPECT_FALSE(maps(stats, "OSMesa"));
  EXPECT_FALSE(maps(stats, "libGL"));
}

TEST(Effects, SsaoAloneMapsNoOpenCl) {
  const TemporaryFolder folder;
  const auto stats = stats_of(folder, "[renderer]\nrealtime = true\ntype = \"ssao\"\n");
  EXPECT_TRUE(maps(stats, "OSMesa"));
  EXPECT_FALSE(maps(stats, "OpenCL"));
  EXPECT_FALSE(maps(stats, "pocl"));
  EXPECT_EQ(stats["rays"]["camera"], 0);
  EXPECT_EQ(stats["seconds"]["bvh"], 0);
}

TEST(Effects, SsaoBesideAoIsItsOwnLayer) {
  const TemporaryFolder folder;
  const Image both = render_with_nook(
      folder, write_small_scene(folder, "both.toml",
                                renderer + "[[effect]]\ntype = \"ssao\"\n[[effect]]\ntype = \"ao\"\n"));
  const auto ao = plane(render_with_nook(folder, write_small_scene(folder, "ao.toml", renderer)), "R");
  const auto ssao = plane(
      render_with_nook(
          folder, write_small_scene(folder, "ssao.toml", "[renderer]\nrealtime = true\ntype = \"ssao\"\n")),
      "R");
  EXPECT_EQ(plane(both, "R"), ao);
  EXPECT_EQ(plane(both, "ssao.R"), ssao);
}

TEST(Effects, PlanOpensNoDevice) {
  const TemporaryFolder folder;
  const auto scene = write_small_scene(folder, "scene.toml", renderer);
  const ProgramResult said = run_nook(folder, "plan '" + scene.string() + "'");
  EXPECT_EQ(said.code, 0);
  for (const char* part : {"Layers", "Passes", "stage/occlusion.cl", "-DEFFECT=0", "tree nodes", "Left out",
                           "at most 6 912 rays"})
    EXPECT_NE(said.out.find(part), std::string::npos) << part << "\n" << said.out;
}

}  // namespace
}  // namespace nook::test
