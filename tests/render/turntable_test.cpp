// nook render --turntable: numbered pictures along a turn, offline and in real time.
#include <gtest/gtest.h>

#include <cmath>

#include "support/nook_program.hpp"

namespace nook::test {
namespace {

constexpr const char* offline = "[renderer]\ntype = \"ao\"\nspp = 16\nmax_distance = 1.0\n";
constexpr const char* screen_space =
    "[renderer]\nrealtime = true\ntype = \"ssao\"\nmethod = \"march\"\nradius = 1.0\n";

class Turntable : public ::testing::TestWithParam<const char*> {
 protected:
  // Renders pictures turn_0000.exr, ... of small.obj.
  void turn(const std::string& options) {
    const auto scene = write_small_scene(folder, "scene.toml", GetParam());
    const ProgramResult run = run_nook(folder, "render '" + scene.string() + "' -o '" +
                                                   (folder / "turn.exr").string() + "' --quiet " + options);
    EXPECT_EQ(run.code, 0) << run.err;
  }
  std::vector<float> picture(const std::string& name) { return plane(read_exr(folder / name), "R"); }

  TemporaryFolder folder;
};

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / double(a.size()));
}

TEST_P(Turntable, TurnsTheEyeAboutTheUpAxisThroughAt) {
  turn("--no-png --turntable 4 --stats '" + (folder / "turn.json").string() + "'");
  EXPECT_FALSE(std::filesystem::exists(folder / "turn.exr"));
  EXPECT_FALSE(std::filesystem::exists(folder / "turn_0004.exr"));
  for (const char* stats : {"turn_0000.json", "turn_0003.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / stats)) << stats;

  // Picture 0 is the still one.
  const auto scene = folder / "scene.toml";
  EXPECT_EQ(picture("turn_0000.exr"), plane(render_with_nook(folder, scene), "R"));

  // A quarter turn, counter-clockwise seen from above, takes the eye at (2.5, 2.2, 5) to (5, 2.2, -2.5) and
  // so on. The eye is there to within rounding, which a few pixels at edges show.
  const std::string text = read_bytes(scene), eye = "eye = [2.5, 2.2, 5.0]";
  const char* turned[] = {"eye = [5.0, 2.2, -2.5]", "eye = [-2.5, 2.2, -5.0]", "eye = [-5.0, 2.2, 2.5]"};
  for (int i = 1; i < 4; ++i) {
    std::string other = text;
    other.replace(other.find(eye), eye.size(), turned[i - 1]);
    write_bytes(folder / "other.toml", other);
    const std::vector<float> still = plane(render_with_nook(folder, folder / "other.toml"), "R");
    EXPECT_LT(rms_difference(still, picture("turn_000" + std::to_string(i) + ".exr")), 0.02) << i;
    EXPECT_GT(rms_difference(still, picture("turn_0000.exr")), 0.1) << i;
  }
}

TEST_P(Turntable, RepeatsToTheBitAndNumbersThePreviews) {
  turn("--turntable 3");
  const std::vector<float> first = picture("turn_0002.exr");
  EXPECT_TRUE(std::filesystem::exists(folder / "turn_0002.png"));
  turn("--turntable 3");
  EXPECT_EQ(first, picture("turn_0002.exr"));
}

// A mesh without a scene is framed once for the whole turn: the long box, which fills the width from the
// side, is as near in every picture, whole, and each picture can be made again from itself.
TEST(TurntableOfAMesh, FramesTheWholeTurn) {
  const TemporaryFolder folder;
  write_bytes(folder / "rod.obj",
              "v -4 0 -.5\nv 4 0 -.5\nv 4 0 .5\nv -4 0 .5\nv -4 1 -.5\nv 4 1 -.5\nv 4 1 .5\n"
              "v -4 1 .5\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  const std::string render = "render '" + (folder / "rod.obj").string() +
                             "' --view 0,10 --ground none --aov alpha --size 64x32 --quiet -o '" +
                             (folder / "a.exr").string() + "' --turntable 4";
  ASSERT_EQ(run_nook(folder, render).code, 0);
  const auto width = [&](const std::string& file) {
    const Image image = read_exr(folder / file);
    const std::vector<float> alpha = plane(image, "A");
    int first = image.width, last = -1;
    for (int i = 0; i < image.width * image.height; ++i)
      if (alpha[std::size_t(i)] > 0)
        first = std::min(first, i % image.width), last = std::max(last, i % image.width);
    EXPECT_GE(first, 5) << file;  // 8 % of 64 pixels
    EXPECT_LE(last, 58) << file;
    return last - first + 1;
  };
  EXPECT_GT(width("a_0000.exr"), 40);
  EXPECT_LT(width("a_0001.exr"), 20);
  EXPECT_EQ(width("a_0002.exr"), width("a_0000.exr"));
  EXPECT_EQ(width("a_0003.exr"), width("a_0001.exr"));
}

TEST(TurntableOfAMesh, ItsPicturesCanBeMadeAgain) {
  const TemporaryFolder folder;
  write_bytes(folder / "small.obj", small_obj);
  const std::string end = " --quiet --no-png -o '" + (folder / "a.exr").string() + "'";
  ASSERT_EQ(run_nook(folder, "render '" + (folder / "small.obj").string() +
                                 "' --up z --size 32x24 --turntable 3" + end)
                .code,
            0);
  ASSERT_EQ(run_nook(folder, "render '" + (folder / "a_0001.exr").string() + "'" + end).code, 0);
  EXPECT_EQ(plane(read_exr(folder / "a.exr"), "R"), plane(read_exr(folder / "a_0001.exr"), "R"));
  EXPECT_NE(plane(read_exr(folder / "a.exr"), "R"), plane(read_exr(folder / "a_0002.exr"), "R"));
}

INSTANTIATE_TEST_SUITE_P(Both, Turntable, ::testing::Values(offline, screen_space),
                         [](const auto& scene) { return scene.index == 0 ? "Offline" : "ScreenSpace"; });

}  // namespace
}  // namespace nook::test
