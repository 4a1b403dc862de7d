// A study keeps to its budget by the clock on the wall (NOOK_TEST_LONG, on a machine with nothing else to
// do), and says so where the budget is below what it takes at least.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include "support/nook_program.hpp"
#include "trace/deadline.hpp"

namespace nook {
namespace {

TEST(StudyBudget, TheCornellBoxTakesLessThanThreeMinutes) {
  if (!std::getenv("NOOK_TEST_LONG")) GTEST_SKIP() << "takes two minutes: NOOK_TEST_LONG=1";
  const std::filesystem::path scenes = std::filesystem::path(NOOK_SOURCE_DIR) / "scenes";
  if (!std::filesystem::exists(scenes / "generated" / "cbox.obj")) GTEST_SKIP() << "scenes are not generated";
  for (const char* scene : {"cbox_ao_cosine.toml", "cbox_ro.toml"}) {
    const test::TemporaryFolder folder;
    const double start = Deadline::steady_seconds();
    const std::string command = std::string(NOOK_PROGRAM) + " study --quiet " + (scenes / scene).string() +
                                " -o " + (folder.path() / "study").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    const double seconds = Deadline::steady_seconds() - start;
    std::printf("%s: %.1f s\n", scene, seconds);
    EXPECT_LE(seconds, 180) << scene;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "study" / "index.html"));
  }
}

TEST(StudyBudget, BelowTheLeastThatAStudyTakesItSaysSo) {
  const test::TemporaryFolder folder;
  const std::filesystem::path scene =
      test::write_small_scene(folder, "scene.toml", "[renderer]\ntype = \"ao\"\n");
  const double start = Deadline::steady_seconds();
  const test::ProgramResult run =
      test::run_nook(folder, "study --quiet '" + scene.string() + "' -o '" + (folder / "study").string() +
                                 "' --budget 1 --samplings cosine --samplers sobol --no-plots --no-gallery");
  const double seconds = Deadline::steady_seconds() - start;
  EXPECT_EQ(run.code, 0) << run.err;
  // What counts is the study's own clock, which started a little later.
  if (seconds > 6) {
    EXPECT_TRUE(
        std::regex_search(run.err, std::regex("warning: the study took \\d+ s, more than its budget of 1 s: "
                                              ".* the kernels of \\d+ methods, a run of each")))
        << run.err;
  }
  if (seconds < 2) {
    EXPECT_EQ(run.err.find("more than its budget"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "study" / "index.html"));
}

}  // namespace
}  // namespace nook
