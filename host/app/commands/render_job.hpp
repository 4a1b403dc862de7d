#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/options/picture_scene.hpp"
#include "app/options/render_options.hpp"
#include "app/progress.hpp"
#include "base/stopwatch.hpp"
#include "render/scene_renderer.hpp"
#include "trace/deadline.hpp"

namespace nook {

/// What `nook render` is asked for, checked before anything is loaded.
struct Job {
  const RenderOptions& options;
  double start = Deadline::steady_seconds();
  Stopwatch whole;
  PictureOrigin origin;  // where a picture is the scene
  std::vector<std::string> aovs;
  ProgressMode progress = ProgressMode::none;
  std::optional<Share> shard;
  std::filesystem::path part_file, output;
};

/// Checks options and files against the scene, whose stop target becomes that of the options. `options` must
/// outlive the job. Throws Error.
Job checked(Scene& scene, const RenderOptions& options);

/// The scene's renderer: its mesh is loaded, and what the readers warn of said. `channels`: as --aov names
/// them.
SceneRenderer make_renderer(const Scene& scene, const RenderOptions& options,
                            const std::vector<std::string>& channels);

}  // namespace nook
