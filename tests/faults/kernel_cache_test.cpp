// The cache of built kernels may be damaged, shared, unwritable: a run is right all the same.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bad_input_rows.hpp"
#include "film/exr.hpp"
#include "support/program.hpp"

namespace nook::test {
namespace {

class KernelCache : public testing::Test {
 protected:
  KernelCache() {
    write_small_scene(folder.path());
    setting.folder = folder.path();
    setting.environment = {{"NOOK_CACHE_DIR", (folder / "cache").string()}};
  }
  /// The picture as values; the run must succeed.
  std::vector<float> render(const std::string& output) {
    setting.arguments = words("render scene.toml --quiet --no-png -o " + output);
    const ProgramResult result = run_program(NOOK_PROGRAM, setting);
    EXPECT_EQ(result.code, 0) << result.err;
    return picture(output);
  }
  std::vector<float> picture(const std::string& output) {
    return std::get<std::vector<float>>(read_exr(folder / output).find("R")->values);
  }

  TemporaryFolder folder;
  ProgramSetting setting;
};

TEST_F(KernelCache, DamagedEntriesAreRebuilt) {
  const std::vector<float> first = render("first.exr");
  std::vector<std::filesystem::path> entries;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache"))
    entries.push_back(entry.path());
  ASSERT_FALSE(entries.empty());
  const auto spoil_all = [&](auto spoil) {
    for (const auto& file : entries) {
      std::string bytes = read_bytes(file);
      spoil(bytes);
      write_bytes(file, bytes);
    }
  };
  spoil_all([](std::string& bytes) { bytes[bytes.size() / 2] ^= 1; });
  EXPECT_EQ(render("flipped.exr"), first);
  spoil_all([](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  EXPECT_EQ(render("cut.exr"), first);
  spoil_all([](std::string& bytes) { bytes.clear(); });
  EXPECT_EQ(render("empty.exr"), first);
  spoil_all([](std::string& bytes) {
    bytes[8] = bytes[9] = bytes[10] = bytes[11] = bytes[12] = '\x7f';
  });  // its length
  EXPECT_EQ(render("long.exr"), first);
}

TEST_F(KernelCache, CannotBeWritten) {
  const std::vector<float> first = render("first.exr");
  setting.environment = {{"NOOK_CACHE_DIR", "/proc/nook-cache"}};
  EXPECT_EQ(render("uncached.exr"), first);
}

TEST_F(KernelCache, SharedByProcessesThatStartAtOnce) {
  std::vector<std::unique_ptr<RunningProgram>> running;
  for (int i = 0; i < 4; ++i) {
    setting.arguments = words("render scene.toml --quiet --no-png -o " + std::to_string(i) + ".exr");
    running.push_back(std::make_unique<RunningProgram>(NOOK_PROGRAM, setting));
  }
  for (auto& program : running) {
    const ProgramResult result = program->wait();
    EXPECT_EQ(result.code, 0) << result.err;
  }
  for (int i = 1; i < 4; ++i) EXPECT_EQ(picture(std::to_string(i) + ".exr"), picture("0.exr"));
}

}  // namespace
}  // namespace nook::test
