// Every command that reads a mesh for an effect warns alike where the mesh's proportions are beyond floats.
#include <gtest/gtest.h>

#include "support/nook_program.hpp"

namespace nook::test {
namespace {

TEST(ProportionsProgram, EveryCommandWarnsAlike) {
  const TemporaryFolder folder;
  write_bytes(folder / "sheet.obj",
              "v 0 0 0\nv 1e8 1e8 0\nv 0 1e8 1e8\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  write_bytes(
      folder / "scene.toml",
      "[input]\nobjfile = \"sheet.obj\"\n[camera]\neye = [3e8, 2e8, 0]\n[film]\nwidth = 4\nheight = 4\n"
      "[renderer]\ntype = \"ao\"\nmax_distance = 2.0\n");
  write_bytes(folder / "points.csv", "0,1,0,0,1,0\n");
  const std::string scene = "'" + (folder / "scene.toml").string() + "'",
                    to = " -o '" + (folder / "out").string();
  const std::string line =
      "warning: " + (folder / "sheet.obj").string() +
      ": triangle 1 is 5.0e+07 times as large as the max_distance of ao (2): its corners "
      "are too coarse as floats, values near it may be off by more than .001\n";
  for (const std::string& arguments :
       {"info " + scene, "plan " + scene, "render " + scene + to + ".exr' --no-png --quiet",
        "probe " + scene + " --samples 16 --points '" + (folder / "points.csv").string() + "'",
        "bake " + scene + " --to vertices --directions 16" + to + ".ply'",
        "bake " + scene + " --to texture --size 4 --directions 16" + to + ".png'"}) {
    const ProgramResult run = run_nook(folder, arguments);
    EXPECT_EQ(run.code, 0) << arguments << run.err;
    const std::size_t place = run.err.find("warning: ");
    ASSERT_NE(place, std::string::npos) << arguments << run.err;
    EXPECT_EQ(run.err.substr(place, run.err.find('\n', place) + 1 - place), line) << arguments;
    EXPECT_EQ(run.err.find("warning: ", place + 1), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace nook::test
