// Settings of a program are read as a scene file's keys are, and refused in the same words.
#include "scene/settings.hpp"

#include <gtest/gtest.h>

#include "scene/scene_toml.hpp"
#include "support/expect_error.hpp"

namespace nook {
namespace {

Scene with(const std::string& lines, bool of_mesh = false) {
  Scene scene = scene_of_mesh("mesh");
  apply_settings(lines, of_mesh, scene);
  return scene;
}

TEST(Settings, SetKeysOfEveryTable) {
  const Scene scene = with("spp = 8\nwidth = 33\nfov = 40\nmax_distance = 0.5\nsampler = \"halton\"\n");
  EXPECT_EQ(scene.spp, 8u);
  EXPECT_EQ(scene.width, 33);
  EXPECT_EQ(scene.camera.fov, 40);
  EXPECT_EQ(scene.effects.front().max_distance.value, 0.5f);
  EXPECT_EQ(scene.sampler, Sampler::halton);
  EXPECT_TRUE(scene.automatic_camera);
  EXPECT_FALSE(with("eye = [1, 2, 3]\n").automatic_camera);
}

// Of a camera that frames the mesh, up is the mesh's: it stays one.
TEST(Settings, AViewAndWhatIsUpLeaveTheCameraFraming) {
  const Scene scene = with("up = \"z\"\nview = \"left\"\nmargin = 0.2\n");
  EXPECT_TRUE(scene.automatic_camera);
  EXPECT_EQ(scene.camera.up, vec3(0, 0, 1));
  EXPECT_EQ(scene.view.azimuth, with("view = \"-90,0\"\n").view.azimuth);
  EXPECT_EQ(scene.margin, 0.2f);
  Scene placed = with("eye = [1, 2, 3]\n");
  apply_settings("view = \"top\"\n", false, placed);
  EXPECT_TRUE(placed.automatic_camera);
}

TEST(Settings, ChooseEffects) {
  EXPECT_EQ(with("type = \"ro\"\nexponent = 7\n").effects.front().exponent, 7);
  EXPECT_EQ(with("realtime = true\n").effects.front().kind, EffectKind::ssao);
  const Scene listed = with("effect = [{type = \"ao\"}, {type = \"ro\", name = \"gloss\"}]\nexponent = 9\n");
  ASSERT_EQ(listed.effects.size(), 2u);
  EXPECT_EQ(listed.effects[1].exponent, 9);
  EXPECT_EQ(listed.effects[0].exponent, Effect().exponent);
}

TEST(Settings, SppEndsATargetOfTheScene) {
  Scene scene = with("error = 0.1\n");
  EXPECT_TRUE(scene.stop.any());
  apply_settings("spp = 4\n", false, scene);
  EXPECT_FALSE(scene.stop.any());
}

TEST(Settings, AreRefusedInTheWordsOfASceneFile) {
  const auto refuses = [](const std::string& lines, const std::string& says) {
    test::expect_error(ErrorKind::usage, says, [&] { with(lines); });
  };
  refuses("smapler = 1\n", "unknown key 'smapler' in a scene, did you mean 'sampler'?");
  refuses("spp = 0\n", "spp must be an integer from 1 to 67108864");
  refuses("spp = 2\ntime = 3\n", "exclude one another");
  refuses("exponent = 3\n", "exponent: the scene has no effect of type ro");
  refuses("error = 0.1\nmin_spp = 9\nmax_spp = 8\n", "min_spp: is above max_spp, 8");
  refuses("name = \"x\"\n", "unknown key 'name'");
  refuses("type = \"ro\"\nrealtime = true\n", "realtime = true renders type \"ssao\" alone");
  refuses("ground = {}\n", "unknown key 'ground'");
  refuses("frame = false\nview = \"left\"\n", "view: frames the mesh: frame = false goes with eye and at");
  refuses("view = \"left\"\neye = [1, 2, 3]\n", "eye and at follow from frame = true, or from view");
  refuses("eye = [1, 2, 3]\nmargin = 0.1\n", "margin goes with frame = true, or with view");
  refuses("spp = \n", "");
}

TEST(Settings, OfTheMeshAreGivenOnce) {
  EXPECT_EQ(with("ground = {height = 2}\n", true).ground->height, 2);
  test::expect_error(ErrorKind::usage, "needs a scene file with [[instance]]",
                     [] { with("instancing = \"tree\"\n", true); });
}

}  // namespace
}  // namespace nook
