#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bad_input_rows.hpp"
#include "image/exr.hpp"
#include "small_scene.hpp"
#include "support/program.hpp"

namespace nook::test {

/// The program in a folder with the small scene, and pictures that must have the same bits.
class NothingLost : public testing::Test {
 protected:
  NothingLost() { write_small_scene(folder.path()); }

  ProgramSetting setting(const std::string& command) const {
    ProgramSetting made;
    made.arguments = words(command + " --quiet");
    made.folder = folder.path();
    return made;
  }
  ProgramResult run(const std::string& command) const { return run_program(NOOK_PROGRAM, setting(command)); }
  void succeed(const std::string& command) const {
    const ProgramResult result = run(command);
    ASSERT_EQ(result.code, 0) << command << ": " << result.err;
  }
  /// Waits until the program has written the file (anew). False: it ended first.
  static bool writes(RunningProgram& program, const std::filesystem::path& file) {
    std::error_code code;
    const auto before = std::filesystem::last_write_time(file, code);
    while (!program.ended_within(0.005)) {
      const auto now = std::filesystem::last_write_time(file, code);
      if (!code && now != before) return true;
    }
    return false;
  }
  /// Every channel to the bit, and all metadata but times and what names the file.
  void expect_same_picture(const std::string& a, const std::string& b) const {
    const Image x = read_exr(folder / a), y = read_exr(folder / b);
    ASSERT_EQ(x.channels.size(), y.channels.size());
    for (const Channel& channel : x.channels) {
      const Channel* other = y.find(channel.name);
      ASSERT_TRUE(other) << channel.name;
      EXPECT_TRUE(channel.values == other->values)
          << channel.name << " differs between " << a << " and " << b;
    }
    for (const auto& [name, value] : x.metadata)
      if (!name.starts_with("nook/seconds")) {
        EXPECT_EQ(y.metadata.at(name), value) << name;
      }
  }

  TemporaryFolder folder;
};

// About a second of work on two cores.
inline const std::string long_render =
    "render scene.toml --no-png --size 128x96 --spp 1024 --directions 8 --aov normal,variance";

// Renders to an error: counts, randomised sequences, and, with an RO layer, pilots; each about a second of
// work. What a rule has decided must survive as well as the sums.
inline const std::string two_layers =
    "[[effect]]\ntype = \"ao\"\nmax_distance = 1.0\n[[effect]]\nname = \"ro\"\ntype = \"ro\"\nexponent = 4\n";
inline const std::string renders_to_an_error[] = {
    "render scene.toml --sampler independent --error .005", "render scene.toml --error .0015",
    "render layers.toml --sampler independent --error .012", "render layers.toml --error .0025"};
inline const std::string with_aovs = " --no-png --size 128x96 --aov variance,samples,normal";

class NothingLostToAnError : public NothingLost {
 protected:
  NothingLostToAnError() {
    write_bytes(folder / "layers.toml",
                with(small_scene, "type = \"ao\"\nspp = 4\nmax_distance = 1.0\n", two_layers));
  }
};

}  // namespace nook::test
