// Random command lines, seeded: whatever is asked, the program ends with one of its documented codes, and
// says a line where that is not 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "bad_input_rows.hpp"
#include "small_scene.hpp"
#include "support/program.hpp"

namespace nook::test {
namespace {

TEST(CommandLine, RandomWordsEndInDocumentedCodes) {
  TemporaryFolder folder;
  write_small_scene(folder.path());
  write_bytes(folder / "points.csv", "0,0,0,0,0,1\n");
  const std::vector<std::string> commands = {"render",  "probe",   "info", "merge",
                                             "compare", "devices", "plan"};
  const std::vector<std::string> more = {"scene.toml",
                                         "mesh.obj",
                                         "points.csv",
                                         "none",
                                         "",
                                         "-",
                                         "--",
                                         "-o",
                                         "o.exr",
                                         "--spp",
                                         "2",
                                         "0",
                                         "-1",
                                         "1e9",
                                         "nan",
                                         "99999999999999999999",
                                         "--size",
                                         "4x4",
                                         "0x0",
                                         "--crop",
                                         "0,2,0,2",
                                         "1,,2",
                                         "--sampling",
                                         "cosine",
                                         "lobe",
                                         "--sampler",
                                         "sobol",
                                         "--max-distance",
                                         "none",
                                         "inf",
                                         "--exponent",
                                         "--seed",
                                         "--device",
                                         "cpu",
                                         "9:9",
                                         "--threads",
                                         "--aov",
                                         "normal,depth",
                                         "--progress",
                                         "json",
                                         "--checkpoint",
                                         "c.nook",
                                         "--every",
                                         "--resume",
                                         "--shard",
                                         "1/2",
                                         "3/2",
                                         "--points",
                                         "--effect",
                                         "ro",
                                         "--samples",
                                         "--status",
                                         "--partial",
                                         "--quiet",
                                         "--print-config",
                                         "--help",
                                         "--version",
                                         "--no-png",
                                         "--stats",
                                         "s.json",
                                         "\xff\xfe",
                                         "%s%n",
                                         "=",
                                         "--spp=3",
                                         "-o=x"};
  std::mt19937 random(3);
  const std::set<int> documented = {0, 1, 2, 3, 4, 5, 6};
  for (int round = 0; round < 120; ++round) {
    ProgramSetting setting;
    setting.folder = folder.path();
    setting.timeout = 20;
    setting.arguments = {commands[random() % commands.size()]};
    for (unsigned n = random() % 6; n > 0; --n) setting.arguments.push_back(more[random() % more.size()]);
    std::string line;
    for (const std::string& word : setting.arguments) line += " '" + word + "'";
    const ProgramResult result = run_program(NOOK_PROGRAM, setting);
    EXPECT_TRUE(documented.count(result.code)) << line << " ended with " << result.code << ": " << result.err;
    // 1 is a defect, but for compare, where it is a warning.
    if (setting.arguments[0] != "compare") {
      EXPECT_NE(result.code, 1) << line << ": " << result.err;
    }
    if (result.code > 1 && result.code != 5 && setting.arguments[0] != "compare") {
      EXPECT_TRUE(result.err.find("nook: ") != std::string::npos && result.err.back() == '\n')
          << line << ": " << result.err;
    }
  }
}

ProgramResult run_in(const TemporaryFolder& folder, const std::string& command) {
  ProgramSetting setting;
  setting.folder = folder.path();
  setting.arguments = words(command);
  return run_program(NOOK_PROGRAM, setting);
}

// The flags belong to the effect that is probed, not to the one that the scene has.
TEST(CommandLine, ProbesABareMeshForReflections) {
  TemporaryFolder folder;
  write_small_scene(folder.path());
  write_bytes(folder / "points.csv", "0,0,1,0,0,1,0,0,1\n");
  for (const char* more : {"--sampling lobe", "--sampling mixture --exponent 20", "--exponent 3"}) {
    const ProgramResult result =
        run_in(folder, std::string("probe mesh.obj --points points.csv --effect ro --samples 16 ") + more);
    EXPECT_EQ(result.code, 0) << more << ": " << result.err;
    EXPECT_TRUE(result.out.starts_with("value,standard_error,samples\n")) << result.out;
  }
}

TEST(CommandLine, HelpShowsWhatACommandReads) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> unread = {
      {"probe", {"--spp", "--directions", "--size", "--crop", "--radius", "--method"}},
      {"bake", {"--exponent", "--radius", "--method", "--quality", "--crop"}},
      {"study", {"--spp", "--directions", "--sampling ", "--sampler ", "--crop", "--method"}}};
  TemporaryFolder folder;
  for (const auto& [command, flags] : unread) {
    const ProgramResult help = run_in(folder, command + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("--max-distance "), std::string::npos) << help.out;
    for (const std::string& flag : flags)
      EXPECT_EQ(help.out.find("  " + flag), std::string::npos) << command << " does not read " << flag;
  }
}

}  // namespace
}  // namespace nook::test
