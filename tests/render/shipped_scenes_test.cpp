// nook plan explains every scene that is shipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/nook_program.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {
namespace {

std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(NOOK_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

bool has_pass(const nlohmann::json& plan, const std::string& name) {
  return std::any_of(plan["passes"].begin(), plan["passes"].end(),
                     [&](const nlohmann::json& pass) { return pass["name"] == name; });
}

class ShippedScenePlan : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScenePlan, IsExplained) {
  const TemporaryFolder folder;
  const ProgramResult run = run_nook(folder, "plan --json '" + GetParam().string() + "'");
  if (run.code == 3 && run.err.find("generated/") != std::string::npos &&
      run.err.find("no such file") != std::string::npos)
    GTEST_SKIP() << "its mesh has not been generated";
  ASSERT_EQ(run.code, 0) << run.err;
  const auto plan = nlohmann::json::parse(run.out);
  EXPECT_FALSE(plan["layers"].empty());
  EXPECT_FALSE(plan["libraries"].empty());
  EXPECT_FALSE(plan["left_out"].empty());
  const bool ssao = has_pass(plan, "ssao"), traced = has_pass(plan, "occlusion") || has_pass(plan, "surface");
  EXPECT_TRUE(ssao || traced);
  EXPECT_EQ(plan["kernels"].empty(), !traced);
  EXPECT_EQ(plan["buffers"].empty(), !traced);
  const auto left_out = plan["left_out"].dump();
  EXPECT_EQ(left_out.find("no OpenGL") == std::string::npos, ssao) << left_out;
}

// No sample of it is NaN or infinite: such samples are kept out of the film, and counted.
TEST_P(ShippedScenePlan, RejectsNoSample) {
  const TemporaryFolder folder;
  const std::string scene = "'" + GetParam().string() + "'";
  const ProgramResult planned = run_nook(folder, "plan --json " + scene);
  if (planned.code != 0) GTEST_SKIP() << "its mesh has not been generated";
  const auto plan = nlohmann::json::parse(planned.out);
  const bool sampled = has_pass(plan, "occlusion");
  const std::string out = (folder / "out.exr").string(), record = (folder / "stats.json").string();
  const ProgramResult run = run_nook(folder, "render " + scene + " --size 80x60 --no-png --quiet -o '" + out +
                                                 "' --stats '" + record + "'" + (sampled ? " --spp 4" : ""));
  ASSERT_EQ(run.code, 0) << run.err;
  const auto stats = nlohmann::json::parse(read_bytes(record));
  EXPECT_EQ(stats.at("rejected_samples"), 0);
  EXPECT_EQ(stats.at("rays").at("camera") > 0, sampled || has_pass(plan, "surface"));
  EXPECT_EQ(stats.at("rays").at("occlusion") > 0, sampled);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, ShippedScenePlan, ::testing::ValuesIn(shipped_scenes()), [](const auto& scene) {
      std::string name = scene.param.parent_path().filename().string() + "_" + scene.param.stem().string();
      std::replace_if(
          name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
      return name;
    });

}  // namespace
}  // namespace nook::test
