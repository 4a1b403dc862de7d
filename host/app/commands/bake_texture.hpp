#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "points/texture_points.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What `nook bake --to texture` adds to a bake.
struct TextureOptions {
  std::optional<int> size;        ///< texels on a side; default 1024
  std::optional<int> dilation;    ///< rings of texels around what is covered; default 8
  std::vector<std::string> aovs;  ///< "normal", "position", "variance", "samples"

  void add_to(CLI::App& command);
};

/// Before anything is loaded: the output's format, what a PNG cannot hold, memory. Throws Error.
void check_texture_options(const TextureOptions& options, const Scene& scene,
                           const std::filesystem::path& output);

/// The texels to estimate; what a user should know of them goes to stderr. Throws Error(scene) naming the
/// scene.
TexturePoints points_of_texture(const TextureOptions& options, const Scene& scene, const TriangleMesh& mesh);

/// Estimates the plan's effects at the texels and writes the texture: the channels of a picture, and A, which
/// is 1 on covered texels and 0 elsewhere; or a PNG of the first effect. Throws Error.
void write_texture(const TextureOptions& options, const TexturePoints& texels, SceneRenderer& renderer,
                   RunObserver& observer, const std::filesystem::path& output);

}  // namespace nook
