#pragma once

#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"

namespace nook::test {

/// A tilted square under a smaller one: every pixel near the middle sees some occlusion.
inline const std::string two_squares =
    "v -2 -2 0\nv 2 -2 0.1\nv 2 2 0\nv -2 2 -0.1\nf 1 2 3 4\n"
    "v -0.5 -0.5 0.4\nv 0.5 -0.5 0.4\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\nf 5 6 7 8\n";

inline const std::string small_scene =
    "[input]\nobjfile = \"mesh.obj\"\n"
    "[camera]\neye = [0.5, 0.3, 5.0]\nat = [0.0, 0.0, 0.0]\nup = [0.0, 1.0, 0.0]\nfov = 40.0\n"
    "[film]\nwidth = 8\nheight = 6\n"
    "[renderer]\ntype = \"ao\"\nspp = 4\nmax_distance = 1.0\n";

/// `text` with one part replaced; what to replace must be there.
inline std::string with(std::string text, const std::string& part, const std::string& replacement) {
  text.replace(text.find(part), part.size(), replacement);
  return text;
}

/// scene.toml and mesh.obj in a folder.
inline void write_small_scene(const std::filesystem::path& folder, const std::string& scene = small_scene) {
  write_bytes(folder / "scene.toml", scene);
  write_bytes(folder / "mesh.obj", two_squares);
}

}  // namespace nook::test
