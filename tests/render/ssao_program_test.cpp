// The whole program on small scenes: files, exit codes, and which libraries a run loads.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "image/exr.hpp"
#include "ssao_scenes.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::TemporaryFolder;

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path) {
  std::ofstream out(path);
  for (const vec3& p : mesh.positions) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
}

class SsaoProgram : public ::testing::Test {
 protected:
  SsaoProgram() { write_obj(test::asymmetric_scene(), folder / "mesh.obj"); }

  void write_scene(const std::string& renderer) {
    std::ofstream(folder / "scene.toml")
        << "[input]\nobjfile = \"mesh.obj\"\n[camera]\neye = [1.1, 1.7, 3.1]\n"
           "at = [-0.1, 0.3, 0]\nfov = 40\n[film]\nwidth = 64\nheight = 48\n[renderer]\n"
        << renderer;
  }

  // Runs `nook render scene.toml` with `environment` set for it; returns the exit code. stderr is in the file
  // "stderr".
  int render(const std::string& environment, const std::string& options = "") {
    const std::string command = "env " + environment + " " + NOOK_PROGRAM + " render " +
                                (folder / "scene.toml").string() + " " + options + " 2> " +
                                (folder / "stderr").string();
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // Every library that the dynamic loader opened during a render of the scene.
  std::string libraries_of_a_render() {
    EXPECT_EQ(render("LD_DEBUG=files LD_DEBUG_OUTPUT=" + (folder / "loader").string(), "--quiet"), 0)
        << test::read_bytes(folder / "stderr");
    std::string log;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.path().filename().string().starts_with("loader.")) log += test::read_bytes(entry.path());
    EXPECT_NE(log.find("libc.so"), std::string::npos) << "the loader kept no log";
    return log;
  }

  TemporaryFolder folder;
};

TEST_F(SsaoProgram, WritesTheSameFilesAsOffline) {
  write_scene("realtime = true\ntype = \"ssao\"\nmethod = \"point\"\nradius = 0.3\n");
  ASSERT_EQ(render("NOOK_OSMESA=", "--frames 2 --aov alpha,normal,position,depth"), 0)
      << test::read_bytes(folder / "stderr");
  const Image image = read_exr(folder / "scene.exr");
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 48);
  for (const char* name : {"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "Z"})
    EXPECT_TRUE(image.find(name)) << name;
  EXPECT_EQ(image.metadata.at("nook/effect"), "ssao");
  EXPECT_EQ(image.metadata.at("nook/method"), "point");
  EXPECT_EQ(std::stof(image.metadata.at("nook/radius")), 0.3f);
  EXPECT_TRUE(std::filesystem::exists(folder / "scene.png"));
}

// Nothing of SSAO is kept in parts: to ignore the wish would leave a picture where a part was asked for.
TEST_F(SsaoProgram, SummaryHasTheSecondsOfItsPart) {
  write_scene(
      "spp = 1\n[[effect]]\ntype = \"ao\"\n[[effect]]\nname = \"screen\"\ntype = \"ssao\"\nradius = 0.3\n");
  ASSERT_EQ(render("NOOK_OSMESA=", "--no-png -o " + (folder / "both.exr").string()), 0);
  const std::regex both(R"(both\.exr: load \d.*render \d+\.\d\d s \(.*\), ssao \d+\.\d\d s, write \d)");
  EXPECT_TRUE(std::regex_search(test::read_bytes(folder / "stderr"), both))
      << test::read_bytes(folder / "stderr");
  write_scene("spp = 1\ntype = \"ao\"\n");
  ASSERT_EQ(render("NOOK_OSMESA=", "--no-png -o " + (folder / "one.exr").string()), 0);
  EXPECT_EQ(test::read_bytes(folder / "stderr").find("ssao"), std::string::npos);
}

TEST_F(SsaoProgram, RefusesCheckpointsAndShards) {
  write_scene("realtime = true\ntype = \"ssao\"\n");
  for (const char* option : {"--checkpoint", "--shard 1/2 -o"}) {
    const std::filesystem::path part = folder / "part.nook";
    EXPECT_EQ(render("NOOK_OSMESA=", option + (" " + part.string())), 2);
    EXPECT_NE(test::read_bytes(folder / "stderr").find("no effect with samples"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(part));
  }
}

TEST_F(SsaoProgram, WithoutOsMesaOneLineAndExitCode4) {
  write_scene("realtime = true\ntype = \"ssao\"\n");
  EXPECT_EQ(render("NOOK_OSMESA=libnook-no-such-library.so"), 4);
  const std::string message = test::read_bytes(folder / "stderr");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_NE(message.find("libnook-no-such-library.so"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder / "scene.exr"));
  EXPECT_EQ(render("GALLIUM_DRIVER=typo"), 4);
}

// Both draw with Mesa's rasteriser where there is no GPU: the same picture, but for what a GPU rounds
// differently.
TEST_F(SsaoProgram, SurfacelessEglDrawsTheSamePicture) {
  write_scene("realtime = true\ntype = \"ssao\"\nmethod = \"march\"\nradius = 0.3\n");
  ASSERT_EQ(render("NOOK_GL=osmesa", "--quiet"), 0) << test::read_bytes(folder / "stderr");
  const Image osmesa = read_exr(folder / "scene.exr");
  ASSERT_EQ(render("NOOK_GL=egl", "--quiet"), 0) << test::read_bytes(folder / "stderr");
  const Image egl = read_exr(folder / "scene.exr");
  const auto &a = std::get<std::vector<float>>(osmesa.find("R")->values),
             &b = std::get<std::vector<float>>(egl.find("R")->values);
  ASSERT_EQ(a.size(), b.size());
  const bool software = egl.metadata.at("nook/device").find("llvmpipe") != std::string::npos;
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], software ? 0 : 0.2) << "pixel " << i;
}

TEST_F(SsaoProgram, SsaoAloneLoadsNothingOfOpenCl) {
  write_scene("realtime = true\ntype = \"ssao\"\n");
  const std::string libraries = libraries_of_a_render();
  EXPECT_NE(libraries.find("libOSMesa"), std::string::npos);
  EXPECT_EQ(libraries.find("libOpenCL"), std::string::npos);
  EXPECT_EQ(libraries.find("libpocl"), std::string::npos);
}

TEST_F(SsaoProgram, OfflineLoadsNothingOfOpenGl) {
  write_scene("type = \"ao\"\n");
  const std::string libraries = libraries_of_a_render();
  EXPECT_NE(libraries.find("libOpenCL"), std::string::npos);
  EXPECT_EQ(libraries.find("libOSMesa"), std::string::npos);
  EXPECT_EQ(libraries.find("libGL"), std::string::npos);
}

}  // namespace
}  // namespace nook
