// nook render PICTURE.exr: the scene in a picture's attributes makes the same picture.
#include <gtest/gtest.h>

#include "support/nook_program.hpp"

namespace nook::test {
namespace {

namespace fs = std::filesystem;

class PictureAgain : public ::testing::Test {
 protected:
  ProgramResult nook(const std::string& arguments) { return run_nook(folder, arguments); }
  std::string path(const std::string& name) { return "'" + (folder / name).string() + "'"; }

  // Renders the scene to first.exr and that to again.exr.
  void render_twice(const std::string& renderer, const std::string& options = "") {
    write_small_scene(folder, "scene.toml", renderer);
    const ProgramResult first =
        nook("render " + path("scene.toml") + " --no-png --quiet -o " + path("first.exr") + " " + options);
    ASSERT_EQ(first.code, 0) << first.err;
    again("first.exr");
  }
  void again(const std::string& picture, const std::string& options = "") {
    const ProgramResult second =
        nook("render " + path(picture) + " --no-png --quiet -o " + path("again.exr") + " " + options);
    ASSERT_EQ(second.code, 0) << second.err;
  }
  void expect_same_bits(const std::string& a = "first.exr", const std::string& b = "again.exr") {
    const Image first = read_exr(folder / a), second = read_exr(folder / b);
    ASSERT_EQ(first.channels.size(), second.channels.size());
    for (std::size_t c = 0; c < first.channels.size(); ++c) {
      EXPECT_EQ(first.channels[c].name, second.channels[c].name);
      EXPECT_EQ(first.channels[c].values, second.channels[c].values) << first.channels[c].name;
    }
    EXPECT_EQ(first.metadata.at("nook/scene"), second.metadata.at("nook/scene"));
    EXPECT_EQ(first.metadata.at("nook/scene_hash"), second.metadata.at("nook/scene_hash"));
  }

  TemporaryFolder folder;
};

constexpr const char* of_all = R"([renderer]
spp = 4
directions = 2
sampler = "halton"
seed = 3
denoise = true
[[effect]]
type = "ao"
name = "contact"
max_distance = 0.7
falloff = "smooth"
side = "viewer"
occluders = ["floor", "box"]
[[effect]]
type = "ro"
exponent = "material"
[[effect]]
type = "bent"
space = "view"
cone_angle = 60
[[effect]]
type = "position"
[[effect]]
type = "ssao"
method = "march"
)";

TEST_F(PictureAgain, OfEveryEffect) {
  render_twice(of_all, "--aov variance,alpha --crop 4,40,2,30");
  expect_same_bits();
  const Image image = read_exr(folder / "again.exr");
  EXPECT_EQ(image.metadata.at("nook/effect"), "ao");
  EXPECT_EQ(image.metadata.at("nook/name"), "contact");
  EXPECT_EQ(image.metadata.at("nook/falloff"), "smooth");
  EXPECT_EQ(image.metadata.at("nook/occluders"), "[\"floor\", \"box\"]");
  EXPECT_EQ(image.metadata.at("nook/effect2/exponent"), "material");
  EXPECT_EQ(image.metadata.at("nook/effect4/name"), "ssao");
  const ProgramResult scene = nook("render " + path("first.exr") + " --print-config");
  EXPECT_EQ(scene.out, image.metadata.at("nook/scene"));
}

TEST_F(PictureAgain, OfABareMesh) {
  write_bytes(folder / "small.obj", small_obj);
  write_bytes(folder / "small.mtl", small_mtl);
  ASSERT_EQ(
      nook("render " + path("small.obj") + " --size 32x24 --no-png --quiet -o " + path("first.exr")).code, 0);
  again("first.exr");
  expect_same_bits();
}

TEST_F(PictureAgain, OfScreenSpaceAlone) {
  render_twice("[renderer]\nrealtime = true\ntype = \"ssao\"\nmethod = \"gtao\"\n", "--aov depth");
  expect_same_bits();
}

// Its decisions follow from its samples.
TEST_F(PictureAgain, ToAnError) {
  render_twice("[renderer]\ntype = \"ao\"\nmax_distance = 1.0\nerror = 0.08\nsampler = \"independent\"\n");
  expect_same_bits();
}

// The clock decides what each pixel gets: a channel says it.
TEST_F(PictureAgain, ForATime) {
  render_twice("[renderer]\ntype = \"ao\"\nmax_distance = 1.0\n", "--time 0.3 --max-spp 4096");
  const Image image = read_exr(folder / "first.exr");
  ASSERT_TRUE(image.find("camera_rays"));
  expect_same_bits();
}

TEST_F(PictureAgain, OfMergedParts) {
  write_small_scene(folder, "scene.toml", "[renderer]\ntype = \"ao\"\nspp = 4\nmax_distance = 1.0\n");
  for (const std::string part : {"1/2", "2/2"})
    ASSERT_EQ(nook("render " + path("scene.toml") + " --quiet --shard " + part + " -o " +
                   path(part.substr(0, 1) + ".nook"))
                  .code,
              0);
  ASSERT_EQ(nook("merge " + path("1.nook") + " " + path("2.nook") + " --no-png -o " + path("first.exr")).code,
            0);
  again("first.exr");
  expect_same_bits();
  // Half of the samples are none that a render would take.
  ASSERT_EQ(nook("merge " + path("1.nook") + " --partial --no-png -o " + path("half.exr")).code, 0);
  const ProgramResult refused = nook("render " + path("half.exr") + " -o " + path("x.exr"));
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("cannot be made again: it is of parts that lack samples"), std::string::npos)
      << refused.err;
  again("half.exr", "--spp 4");
  EXPECT_EQ(read_exr(folder / "again.exr").find("R")->values,
            read_exr(folder / "first.exr").find("R")->values);
}

TEST_F(PictureAgain, PictureAndMeshMayMoveTogether) {
  render_twice("[renderer]\ntype = \"ao\"\nspp = 2\n");
  fs::create_directories(folder / "moved");
  for (const char* file : {"small.obj", "small.mtl", "first.exr"})
    fs::rename(folder / file, folder / "moved" / file);
  again("moved/first.exr");
  const Image first = read_exr(folder / "moved/first.exr"), second = read_exr(folder / "again.exr");
  EXPECT_EQ(first.find("R")->values, second.find("R")->values);
}

TEST_F(PictureAgain, AnotherMeshIsOneLine) {
  render_twice("[renderer]\ntype = \"ao\"\nspp = 2\n");
  std::string other = small_obj;
  other.replace(other.find("v -2 2 -2"), 9, "v -2 3 -2");
  write_bytes(folder / "small.obj", other);
  const ProgramResult refused = nook("render " + path("first.exr") + " -o " + path("other.exr"));
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("small.obj is not the mesh that it was made of"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(fs::exists(folder / "other.exr"));
}

TEST_F(PictureAgain, ThePictureItselfIsKept) {
  render_twice("[renderer]\ntype = \"ao\"\nspp = 2\n");
  const std::string before = read_bytes(folder / "first.exr");
  const ProgramResult refused = nook("render " + path("first.exr"));
  EXPECT_EQ(refused.code, 6);
  EXPECT_NE(refused.err.find("is the scene's own file"), std::string::npos) << refused.err;
  EXPECT_EQ(read_bytes(folder / "first.exr"), before);
}

TEST_F(PictureAgain, APictureWithoutASceneIsOneLine) {
  Image image;
  image.width = image.height = 2;
  image.channels.push_back({"R", std::vector<float>(4)});
  write_exr(folder / "bare.exr", image);
  const ProgramResult refused = nook("render " + path("bare.exr") + " -o " + path("x.exr"));
  EXPECT_EQ(refused.code, 3);
  EXPECT_NE(refused.err.find("bare.exr: has no scene in its attributes (nook/scene)"), std::string::npos)
      << refused.err;
}

}  // namespace
}  // namespace nook::test
