// The denoiser on pictures: how much nearer to the truth, and what it leaves alone.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/meshes.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

// A Cornell box, open towards the camera, with a tall and a low box in it.
std::string cornell_obj() {
  TriangleMesh mesh;
  add_box(mesh, {-1, 0, -1}, {1, 2, 1}, true);
  mesh.triangles.resize(10);  // the last side is z = 1
  add_box(mesh, {-0.6f, 0, -0.6f}, {-0.05f, 1.2f, -0.05f});
  add_box(mesh, {0.1f, 0, 0.0f}, {0.65f, 0.6f, 0.55f});
  std::ostringstream obj;
  for (const vec3& p : mesh.positions) obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& t : mesh.triangles) obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return obj.str();
}

std::filesystem::path write_cornell(const TemporaryFolder& folder, const std::string& rest,
                                    const std::string& eye = "3.8") {
  write_bytes(folder / "box.obj", cornell_obj());
  write_bytes(folder / "box.toml",
              "[input]\nobjfile = \"box.obj\"\n[camera]\neye = [0, 1, " + eye +
                  "]\nat = [0, 1, 0]\nfov = 40\n[film]\nwidth = 160\nheight = 120\n[renderer]\n" + rest);
  return folder / "box.toml";
}

double rmse(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

// In so small a picture much is edges: two fifths of the error are left. In the shipped Cornell box at
// 400x300 it is a sixth (docs/effects.md).
TEST(DenoisePicture, ErrorFallsToTwoFifthsAt16Spp) {
  const TemporaryFolder folder;
  const auto scene = write_cornell(folder, "spp = 16\nmax_distance = 1.5\n");
  const auto truth = plane(render_with_nook(folder, scene, "--spp 1024 --seed 5"), "R");
  const auto noisy = plane(render_with_nook(folder, scene), "R");
  const auto denoised = plane(render_with_nook(folder, scene, "--denoise"), "R");
  const double before = rmse(noisy, truth), after = rmse(denoised, truth);
  RecordProperty("rmse_at_16_spp", std::to_string(before));
  RecordProperty("rmse_denoised", std::to_string(after));
  EXPECT_GT(before, 0.03);
  EXPECT_LT(after, before * 0.4) << before << " to " << after;
  for (const float value : denoised) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

// With enough samples the filter finds little to do: its bias falls with the noise.
TEST(DenoisePicture, BiasFallsWithTheNoise) {
  const TemporaryFolder folder;
  const auto scene = write_cornell(folder, "spp = 16\nmax_distance = 1.5\n");
  const auto many = plane(render_with_nook(folder, scene, "--spp 1024"), "R");
  const auto filtered = plane(render_with_nook(folder, scene, "--spp 1024 --denoise"), "R");
  const auto few = plane(render_with_nook(folder, scene, "--denoise"), "R");
  EXPECT_LT(rmse(filtered, many), rmse(few, many) / 2);
}

// The scene's key and the flag are one thing; layers that are not traced, variance and background stay to the
// bit.
TEST(DenoisePicture, LeavesTheRestAlone) {
  const TemporaryFolder folder;
  const std::string effects =
      "[[effect]]\ntype = \"ao\"\nname = \"near\"\n[[effect]]\ntype = \"bent\"\n[[effect]]\ntype = "
      "\"ro\"\nexponent = "
      "20\n[[effect]]\ntype = \"depth\"\n";
  const std::string aovs = "--aov normal,variance,samples,alpha";
  const Image plain = render_with_nook(folder, write_cornell(folder, "spp = 8\n" + effects, "5.8"), aovs);
  const Image flagged = render_with_nook(folder, folder / "box.toml", aovs + " --denoise");
  const Image keyed =
      render_with_nook(folder, write_cornell(folder, "spp = 8\ndenoise = true\n" + effects, "5.8"), aovs);
  for (const Channel& channel : plain.channels) {
    const bool traced = channel.name == "R" || channel.name == "G" || channel.name == "B" ||
                        channel.name == "bent.AO" || channel.name.starts_with("near.R") ||
                        channel.name.starts_with("near.G") || channel.name.starts_with("near.B") ||
                        channel.name == "ro.R" || channel.name == "ro.G" || channel.name == "ro.B";
    ASSERT_TRUE(flagged.find(channel.name)) << channel.name;
    EXPECT_EQ(flagged.find(channel.name)->values == channel.values, !traced) << channel.name;
    EXPECT_TRUE(flagged.find(channel.name)->values == keyed.find(channel.name)->values) << channel.name;
  }
  const auto before = plane(plain, "R"), after = plane(flagged, "R"), alpha = plane(plain, "A");
  int background = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (alpha[i] != 0) continue;
    EXPECT_EQ(after[i], 0);
    ++background;
  }
  EXPECT_GT(background, 1000);
}

}  // namespace
}  // namespace nook::test
