// The cache of built kernels may be damaged, shared, unwritable: a run is right all the same.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "bad_input_rows.hpp"
#include "image/exr.hpp"
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
    if (entry.is_regular_file()) entries.push_back(entry.path());
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

// What was compiled for the picture is what is kept: the code that a PoCL binary has for work-groups of any
// size is that for one work-item, not compiled for it. Else a first run takes a second longer.
TEST_F(KernelCache, KeepsWhatRanWithoutCompilingAgain) {
  setting.environment.push_back({"POCL_CACHE_DIR", ""});
  render("first.exr");
  int kept = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache")) {
    if (!entry.is_regular_file()) continue;
    const std::string bytes = read_bytes(entry.path());
    const auto code_behind = [&](const std::string& name) {
      const std::size_t at = bytes.find(name);
      return at == std::string::npos ? std::string()
                                     : bytes.substr(bytes.find("\x7f"
                                                               "ELF",
                                                               at),
                                                    1 << 14);
    };
    const std::string of_one = code_behind("1-1-1-goffs0/");
    if (of_one.empty()) GTEST_SKIP() << "this PoCL names its files otherwise";
    EXPECT_EQ(of_one.size(), std::size_t(1 << 14));
    EXPECT_TRUE(of_one == code_behind("/0-0-0/"));
    ++kept;
  }
  EXPECT_EQ(kept, 2);
}

// PoCL trusts its own files, so each run has its own, gone at its end; a killed one's go with the next run.
TEST_F(KernelCache, OfPoclIsOneRunsOwn) {
  setting.environment.push_back({"POCL_CACHE_DIR", ""});
  const std::vector<float> first = render("first.exr");
  const std::filesystem::path files = folder / "cache/pocl";
  ASSERT_TRUE(std::filesystem::is_directory(files));
  EXPECT_TRUE(std::filesystem::is_empty(files));

  setting.arguments = words("render scene.toml --quiet --no-png --spp 60000000 -o endless.exr");
  RunningProgram endless(NOOK_PROGRAM, setting);
  const auto entries = [&] {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(files)) found.push_back(entry.path());
    return found;
  };
  for (int wait = 0; entries().size() < 2 && wait < 1000; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto of_endless = entries();
  ASSERT_EQ(of_endless.size(), 2u) << "a folder and its lock";
  EXPECT_EQ(render("beside.exr"), first);
  EXPECT_EQ(entries(), of_endless) << "a living run's folder stays";
  endless.send(SIGKILL);
  endless.wait();
  for (const auto& entry : entries())
    if (std::filesystem::is_directory(entry)) write_bytes(entry / "left", "damaged");
  EXPECT_EQ(render("after.exr"), first);
  EXPECT_TRUE(std::filesystem::is_empty(files));
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
