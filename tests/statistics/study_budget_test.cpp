// A study keeps to its budget by the clock on the wall: NOOK_TEST_LONG, on a machine with nothing else to do.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "support/temporary_folder.hpp"
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

}  // namespace
}  // namespace nook
