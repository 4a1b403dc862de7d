#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "image/exr.hpp"
#include "image/image.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {

/// A floor, a wall and a box in one OBJ with an MTL: material `glossy` (Ns 20) on the box, `plain` (no Ns)
/// elsewhere, groups `floor`, `wall`, `box`; no vertex normals.
inline constexpr const char* small_obj = R"(mtllib small.mtl
v -2 0 -2
v 2 0 -2
v 2 0 2
v -2 0 2
v -2 2 -2
v 2 2 -2
v -0.5 0 -0.5
v 0.5 0 -0.5
v 0.5 0 0.5
v -0.5 0 0.5
v -0.5 1 -0.5
v 0.5 1 -0.5
v 0.5 1 0.5
v -0.5 1 0.5
g floor
usemtl plain
f 1 4 3 2
g wall
f 1 2 6 5
g box
usemtl glossy
f 11 14 13 12
f 10 9 13 14
f 7 11 12 8
f 8 12 13 9
f 7 10 14 11
)";

inline constexpr const char* small_mtl = "newmtl plain\nKd 1 1 1\nnewmtl glossy\nKd 1 1 1\nKs 1 1 1\nNs 20\n";

/// The camera and film tables of a scene that sees all of it and some background, 48x36 pixels.
inline constexpr const char* small_view =
    "[camera]\neye = [2.5, 2.2, 5.0]\nat = [0, 0.7, 0]\nup = [0, 1, 0]\nfov = 40\n[film]\nwidth = 48\nheight "
    "= 36\n";

/// Writes small.obj, small.mtl and NAME with `[input]`, small_view and then `rest`; returns the scene's path.
inline std::filesystem::path write_small_scene(const TemporaryFolder& folder, const std::string& name,
                                               const std::string& rest) {
  write_bytes(folder / "small.obj", small_obj);
  write_bytes(folder / "small.mtl", small_mtl);
  write_bytes(folder / name, std::string("[input]\nobjfile = \"small.obj\"\n") + small_view + rest);
  return folder / name;
}

/// Runs `nook ARGUMENTS` (through the shell: quote as it wants).
inline ProgramResult run_nook(const TemporaryFolder& folder, const std::string& arguments) {
  const std::filesystem::path out = folder / "stdout.txt", err = folder / "stderr.txt";
  const std::string command =
      "'" NOOK_PROGRAM "' " + arguments + " >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(err), 0};
}

/// Renders a scene to a fresh EXR, expects success, and reads it back. `stats`: the run record's JSON text.
inline Image render_with_nook(const TemporaryFolder& folder, const std::filesystem::path& scene,
                              const std::string& arguments = "", std::string* stats = nullptr) {
  const std::filesystem::path output = folder / "rendered.exr", record = folder / "stats.json";
  std::filesystem::remove(output);
  const ProgramResult run =
      run_nook(folder, "render '" + scene.string() + "' -o '" + output.string() +
                           "' --no-png --quiet --stats '" + record.string() + "' " + arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  if (run.code != 0) return {};
  if (stats) *stats = read_bytes(record);
  return read_exr(output);
}

/// The float plane of a channel; fails the test and returns an empty one if there is none.
inline std::vector<float> plane(const Image& image, const std::string& channel) {
  const Channel* found = image.find(channel);
  EXPECT_TRUE(found) << "no channel " << channel;
  const auto* values = found ? std::get_if<std::vector<float>>(&found->values) : nullptr;
  return values ? *values : std::vector<float>();
}

}  // namespace nook::test
