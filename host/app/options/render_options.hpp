#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/checkpoints.hpp"
#include "app/options/scene_options.hpp"
#include "app/options/target_options.hpp"
#include "render/run_checks.hpp"

namespace nook {

/// What `nook render` can be told.
struct RenderOptions {
  SceneOptions scene;
  DeviceOptions device;
  CheckpointOptions checkpoints;
  TargetOptions target;
  std::filesystem::path output, stats;
  std::string progress = "auto";
  std::vector<std::string> aovs;
  std::optional<unsigned> frames;
  unsigned turntable = 0;  ///< pictures along a turn; 0: one picture
  bool png = true, quiet = false, print_config = false, denoise = false;

  void add_to(CLI::App& command);
  /// How long to render `scene`, by its own keys and the flags. Throws Error(usage) for flags that the scene
  /// cannot honour, and for those that exclude one another; before anything is loaded.
  StopTarget check(const Scene& scene) const;
  /// The EXR, if not a part is written.
  std::filesystem::path picture_file() const;
};

/// Throws Error(usage) for a name with an extension other than those that are written, e.g. {".exr"}; a name
/// without any is taken.
void check_extension(const std::filesystem::path& file, std::span<const std::string_view> written);

/// Throws Error(output) unless a file could be made there: tried before the work, not after it.
void check_writable(const std::filesystem::path& file);

}  // namespace nook
