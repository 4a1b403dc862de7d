// nook render MESH: the picture of a mesh without a scene, and what the program says of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "image/png.hpp"
#include "image/srgb.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

class FirstPicture : public ::testing::Test {
 protected:
  void SetUp() override {
    // A unit box whose lowest point is not 0 along any axis.
    write_bytes(folder / "box.obj",
                "v 2 3 4\nv 3 3 4\nv 3 4 4\nv 2 4 4\nv 2 3 5\nv 3 3 5\nv 3 4 5\nv 2 4 5\n"
                "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  }
  ProgramResult nook(const std::string& arguments) {
    const ProgramResult run = run_nook(folder, arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return run;
  }
  std::string path(const std::string& name) { return "'" + (folder / name).string() + "'"; }
  Image render(const std::string& options, const std::string& scene = "box.obj") {
    nook("render " + path(scene) + " --size 64x48 --quiet -o " + path("a.exr") + " " + options);
    return read_exr(folder / "a.exr");
  }
  std::string plan(const std::string& options) { return nook("plan " + path("box.obj") + " " + options).out; }

  TemporaryFolder folder;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(FirstPicture, IsThatOfTheSceneThatPrintConfigWrites) {
  for (const std::string options :
       {"", "--view left --up=-z --margin .2 --background '#204060'", "--ground none"}) {
    SCOPED_TRACE(options);
    const Image of_mesh = render(options);
    const std::string preview = read_bytes(folder / "a.png");
    write_bytes(folder / "printed.toml",
                nook("render " + path("box.obj") + " --size 64x48 --print-config " + options).out);
    const Image of_scene = render("", "printed.toml");
    EXPECT_EQ(plane(of_mesh, "R"), plane(of_scene, "R"));
    EXPECT_EQ(preview, read_bytes(folder / "a.png"));
    EXPECT_EQ(nook("render " + path("printed.toml") + " --size 64x48 --print-config").out,
              read_bytes(folder / "printed.toml"));
  }
}

// Flags, variables and keys are the same settings.
TEST_F(FirstPicture, IsChosenByFlagVariableOrKey) {
  const std::vector<float> by_flag = plane(render("--view back --up z"), "R");
  ASSERT_EQ(setenv("NOOK_VIEW", "back", 1), 0);
  ASSERT_EQ(setenv("NOOK_UP", "z", 1), 0);
  EXPECT_EQ(plane(render(""), "R"), by_flag);
  unsetenv("NOOK_VIEW");
  unsetenv("NOOK_UP");
  write_bytes(folder / "s.toml",
              "[input]\nobjfile = \"box.obj\"\n[ground]\n[camera]\nview = \"back\"\nup = \"z\"\n[renderer]\n"
              "spp = 16\nmax_distance = \"none\"\n");
  EXPECT_EQ(plane(render("", "s.toml"), "R"), by_flag);
  EXPECT_NE(plane(render(""), "R"), by_flag);
}

// From the front nothing is above the horizon but the box, which is opaque. What is above is not, and the
// ground is as its shadow alone: at the horizon nothing is seen.
TEST_F(FirstPicture, HasAlphaInItsPreviewAndNotInItsValues) {
  const Image image = render("--view front --aov alpha");
  const std::vector<float> coverage = plane(image, "A"), values = plane(image, "R");
  EXPECT_EQ(image.find("preview ground"), nullptr);
  const GrayImage alpha = read_png_opacity(folder / "a.png"), color = read_png_opacity(folder / "a.png", 'l');
  ASSERT_EQ(alpha.values.size(), coverage.size());
  EXPECT_EQ(alpha.values[32], 0);              // the top
  EXPECT_EQ(alpha.values[24 * 64 + 32], 255);  // the box
  EXPECT_EQ(coverage[46 * 64 + 32], 1);        // the ground
  EXPECT_NEAR(alpha.values[46 * 64 + 32], 255 - srgb_byte(values[46 * 64 + 32]), 1);
  EXPECT_EQ(color.values[46 * 64 + 32], 0);
  for (int x : {1, 62})
    for (int y = 20; y < 30; ++y) EXPECT_LT(alpha.values[std::size_t(64 * y + x)], 16) << "about the horizon";
  EXPECT_EQ(coverage[26 * 64 + 1], 1);
  EXPECT_EQ(values[32], 0);

  const Image over_white = render("--view front --background white");
  EXPECT_EQ(plane(over_white, "R"), values);
  EXPECT_EQ(read_png_opacity(folder / "a.png", 'm').values[32], 255);
  const GrayImage white = read_png_opacity(folder / "a.png", 'l');
  EXPECT_EQ(white.values[32], 255);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(white.values[i], srgb_byte(values[i] + 1 - coverage[i])) << i;

  // no ground in the color of the mesh: the horizon of a grey picture is grey above and below
  render("--view front --background '#808080'");
  const GrayImage gray = read_png_opacity(folder / "a.png", 'l');
  for (int y : {2, 22, 26, 30}) EXPECT_NEAR(gray.values[std::size_t(64 * y + 1)], 128, 8) << y;
}

// 64 x 48 pixels: 8 % are 5.12 columns and 3.84 rows; the box is square from the front, so rows decide.
TEST_F(FirstPicture, LeavesTheMarginToWithinAPixel) {
  const std::vector<float> coverage = plane(render("--view front --ground none --aov alpha"), "A");
  int top = 48, bottom = -1;
  for (int y = 0; y < 48; ++y)
    if (coverage[std::size_t(y * 64 + 32)] > 0) top = std::min(top, y), bottom = y;
  EXPECT_EQ(top, 3);
  EXPECT_EQ(bottom, 44);
  EXPECT_NEAR(coverage[3 * 64 + 32], 0.16f, 0.07f);
}

TEST_F(FirstPicture, StandsOnAGroundThatFillsIt) {
  const std::vector<float> coverage = plane(render("--aov alpha"), "A");
  EXPECT_EQ(std::count(coverage.begin(), coverage.end(), 1.0f), 64 * 48);
  const std::vector<float> without = plane(render("--aov alpha --ground none"), "A");
  EXPECT_LT(std::count(without.begin(), without.end(), 1.0f), 64 * 48 / 2);
}

TEST_F(FirstPicture, SharesAreMergedIntoTheSamePreview) {
  render("--view front --background '#808080'");
  const std::string whole = read_bytes(folder / "a.png");
  const std::string share =
      "render " + path("box.obj") + " --size 64x48 --quiet --view front --background '#808080'";
  nook(share + " --shard 1/2 -o " + path("1.nook"));
  nook(share + " --shard 2/2 -o " + path("2.nook"));
  nook("merge " + path("1.nook") + " " + path("2.nook") + " --quiet -o " + path("m.exr"));
  EXPECT_EQ(read_bytes(folder / "m.png"), whole);
}

TEST_F(FirstPicture, PlanSaysWhatWasChosen) {
  const std::string three_quarter = plan("");
  EXPECT_TRUE(has(three_quarter,
                  "view             three-quarter (azimuth 30, elevation 25 degrees), up (0, 1, 0), "
                  "free on each side: 8 % of the picture\n"))
      << three_quarter;
  EXPECT_TRUE(has(three_quarter, "ground           at y = 3, ")) << three_quarter;
  EXPECT_TRUE(has(three_quarter, " to each side, facing y\n")) << three_quarter;
  EXPECT_TRUE(has(three_quarter, "background       transparent, in the PNG\n")) << three_quarter;
  const std::string below = plan("--view 10,-40 --up=-z --background white");
  EXPECT_TRUE(has(below, "view             azimuth 10, elevation -40 degrees, up (0, 0, -1), ")) << below;
  EXPECT_TRUE(has(below, "ground           left out: the camera is not above it\n")) << below;
  EXPECT_TRUE(has(below, "background       white, in the PNG\n")) << below;
  // From the front of a unit box about (2.5, 3.5, 4.5), of which .84 of the height are its nearer side's.
  const std::string front = plan("--view front --ground 2.5 --json");
  EXPECT_TRUE(has(front, "\"camera\": \"eye (2.5, 3.5, 7.22")) << front;
  EXPECT_TRUE(has(front, "\"ground\": \"at y = 2.5, ")) << front;
  EXPECT_TRUE(has(plan("--ground none"), "ground           none\n"));
}

// Points know no picture: the mesh alone.
TEST_F(FirstPicture, IsNotWhatOtherCommandsTake) {
  EXPECT_TRUE(has(nook("info " + path("box.obj")).out, "triangles         12\n"));
  write_bytes(folder / "p.csv", "2.5,2.999,4.5,0,-1,0\n");
  EXPECT_TRUE(
      has(nook("probe " + path("box.obj") + " --points " + path("p.csv") + " --samples 64").out, "\n1,"));
}

}  // namespace
}  // namespace nook::test
