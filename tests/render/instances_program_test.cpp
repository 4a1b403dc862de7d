// Instances through the program: what it plans, counts, uploads and writes, against copies.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "plan/scene_mesh.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

// The small scene's mesh placed five times (once mirrored), on a ground.
std::filesystem::path write_instances(const TemporaryFolder& folder, const std::string& instancing,
                                      const std::string& rest) {
  write_small_scene(folder, "plain.toml", "");
  std::string scene = "[input]\nobjfile = \"small.obj\"\ninstancing = \"" + instancing + "\"\n";
  for (const char* place :
       {"translate = [2, 0, -1]\nrotate = [0, 30, 0]", "translate = [-2, 0.1, -1]\nscale = [-0.7, 0.9, 1]",
        "translate = [0.2, 0.9, 0]\nrotate = [10, 70, 5]\nscale = 0.5", "translate = [1, 0, 1]\nscale = 0.3"})
    scene += std::string("[[instance]]\nobjfile = \"small.obj\"\n") + place + "\n";
  write_bytes(folder / (instancing + ".toml"), scene + "[ground]\n" + small_view + rest);
  return folder / (instancing + ".toml");
}

const std::string effects =
    "[renderer]\nspp = 4\n[[effect]]\ntype = \"ao\"\nmax_distance = 2\n[[effect]]\ntype = \"ro\"\nexponent = "
    "\"material\"\n[[effect]]\ntype = \"bent\"\nmax_distance = 1\n[[effect]]\ntype = "
    "\"normal\"\n[[effect]]\ntype = "
    "\"depth\"\n[[effect]]\ntype = \"ao\"\nname = \"box\"\noccluders = [\"box\"]\nreceivers = [\"ground\", "
    "\"floor\"]\n";

TEST(InstancesOfTheProgram, PicturesAndCountersAreThoseOfCopies) {
  const TemporaryFolder folder;
  std::string of_copies, of_trees;
  const Image copies = render_with_nook(folder, write_instances(folder, "copies", effects), "--aov position",
                                        &of_copies),
              trees = render_with_nook(folder, write_instances(folder, "tree", effects), "--aov position",
                                       &of_trees);
  ASSERT_EQ(copies.channels.size(), trees.channels.size());
  for (const Channel& channel : copies.channels)
    EXPECT_EQ(plane(copies, channel.name), plane(trees, channel.name));
  const auto a = nlohmann::json::parse(of_copies), b = nlohmann::json::parse(of_trees);
  EXPECT_EQ(a["rays"], b["rays"]);
  EXPECT_EQ(a["triangles"], b["triangles"]);
  EXPECT_GT(a["rays"]["occlusion"].get<std::uint64_t>(), 0u);
}

TEST(InstancesOfTheProgram, WhatThePlanSaysIsUploaded) {
  const TemporaryFolder folder;
  const auto bytes = [&](const std::string& instancing, bool trees) {
    const auto scene = write_instances(folder, instancing, effects);
    const auto plan = nlohmann::json::parse(run_nook(folder, "plan --json '" + scene.string() + "'").out);
    std::uint64_t sum = 0;
    bool listed = false;
    for (const auto& buffer : plan["buffers"]) {
      sum += buffer["bytes"].get<std::uint64_t>();
      listed = listed || buffer["name"] == "instances";
    }
    EXPECT_EQ(listed, trees);
    for (const auto& kernel : plan["kernels"])
      EXPECT_EQ(kernel["options"].get<std::string>().find("INSTANCES") != std::string::npos, trees);
    std::string stats;
    render_with_nook(folder, scene, "", &stats);
    EXPECT_EQ(nlohmann::json::parse(stats)["bytes_uploaded"], sum);
    return sum;
  };
  EXPECT_LT(bytes("tree", true), bytes("copies", false));
}

TEST(InstancesOfTheProgram, ProbesAndBakesAreThoseOfCopies) {
  const TemporaryFolder folder;
  const std::string ao = "[renderer]\nspp = 1\nmax_distance = 2\n";
  const auto copies = write_instances(folder, "copies", ao), trees = write_instances(folder, "tree", ao);
  write_bytes(folder / "points.csv", "0,0.01,0.8,0,1,0\n1.5,0.5,0,0,1,0\n-1,0.02,0.4,0,1,0\n");
  const auto probe = [&](const std::filesystem::path& scene) {
    return run_nook(folder,
                    "probe '" + scene.string() + "' --points '" + (folder / "points.csv").string() + "'")
        .out;
  };
  EXPECT_EQ(probe(copies), probe(trees));
  EXPECT_NE(probe(trees).find('\n'), std::string::npos);
  const auto bake = [&](const std::filesystem::path& scene) {
    const auto out = folder / "bake.ply";
    EXPECT_EQ(run_nook(folder, "bake '" + scene.string() + "' -o '" + out.string() + "'").code, 0);
    return read_bytes(out);
  };
  EXPECT_EQ(bake(copies), bake(trees));
}

// Automatic: copies for few triangles, for meshes that are placed once, and where an effect needs them.
TEST(InstancesOfTheProgram, ThePlanSaysWhyTheyAreCopies) {
  const TemporaryFolder folder;
  const auto left_out = [&](const std::string& instancing, const std::string& rest) {
    return run_nook(folder, "plan '" + write_instances(folder, instancing, rest).string() + "'").out;
  };
  EXPECT_NE(left_out("auto", effects).find("they are copies: they have 70 triangles, fewer than 1048576"),
            std::string::npos)
      << left_out("auto", effects);
  EXPECT_NE(left_out("copies", effects).find("they are copies: the scene asks for them"), std::string::npos);
  EXPECT_NE(left_out("tree", effects).find("over 6 instances, 72 triangles in all"), std::string::npos)
      << left_out("tree", effects);
  Scene scene;
  scene.effects = {Effect{}};
  const auto why = [&](std::uint64_t stored, std::uint64_t placed) {
    return reason_for_copies(scene, Instancing::automatic, {stored, placed});
  };
  EXPECT_EQ(why(20000, 20000000), "");
  EXPECT_EQ(why(6000000, 10000000), "most meshes are placed once");
  scene.effects[0].only_self = true;
  EXPECT_NE(why(20000, 20000000), "");
}

}  // namespace
}  // namespace nook::test
