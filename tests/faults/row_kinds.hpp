#pragma once

#include "bad_input_rows.hpp"

// What the rows of one kind of input share, and where each kind's rows come from.
namespace nook::test {

inline const std::string render = "render scene.toml -o out.exr --no-png --quiet";
inline const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// The good scene with one part replaced.
inline std::vector<std::pair<std::string, std::string>> scene(const std::string& part,
                                                              const std::string& replacement) {
  return {{"scene.toml", with(small_scene, part, replacement)}};
}

inline std::vector<std::pair<std::string, std::string>> mesh(const std::string& text) {
  return {{"mesh.obj", text}};
}

std::vector<BadInput> scene_rows();
std::vector<BadInput> mesh_rows();
std::vector<BadInput> effect_rows();
std::vector<BadInput> option_rows();
std::vector<BadInput> output_rows();
std::vector<BadInput> device_rows();
std::vector<BadInput> point_rows();
std::vector<BadInput> bake_rows();
std::vector<BadInput> part_rows();

}  // namespace nook::test
