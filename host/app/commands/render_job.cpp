#include "app/commands/render_job.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/options/loading.hpp"
#include "base/driver_threads.hpp"
#include "base/error.hpp"

namespace nook {
namespace {

// What a picture was made of. With overrides its scene makes another picture.
PictureOrigin origin_of(const RenderOptions& options) {
  if (!is_picture(options.scene.scene)) return {};
  PictureOrigin origin = origin_of_picture(options.scene.scene);
  const TargetOptions& target = options.target;
  origin.again = options.scene.given().empty() && !options.scene.size && options.scene.crop.empty() &&
                 !target.error && !target.seconds && !target.confidence && !target.min_spp &&
                 !target.max_spp && options.turntable == 0;
  if (origin.again && !origin.why_not.empty())
    throw Error(ErrorKind::scene, Place{options.scene.scene.string()},
                fmt::format("cannot be made again: {}; --print-config prints its scene, --spp renders it",
                            origin.why_not));
  return origin;
}

}  // namespace

Job checked(Scene& scene, const RenderOptions& options) {
  Job job{options, Deadline::steady_seconds(), {}, origin_of(options), options.aovs, {}, {}, {}, {}};
  if (job.aovs.empty()) job.aovs = job.origin.aovs;
  parse_aovs(job.aovs);
  job.progress = parse_progress(options.progress);
  if (options.quiet) job.progress = ProgressMode::none;
  if (!options.stats.empty()) {
    keep_inputs(scene, options.stats);
    check_writable(options.stats);
  }
  scene.stop = options.check(scene);
  check_memory(scene, job.aovs.size(), scene.stop.error ? largest_rule_bytes : 0);
  job.shard = options.checkpoints.share();
  job.part_file = options.checkpoints.file(options.scene.scene, options.output);
  if (!job.part_file.empty()) check_writable(job.part_file);
  job.output = job.shard ? job.part_file : options.picture_file();
  keep_inputs(scene, job.output);
  static constexpr std::string_view written[] = {".exr"};
  if (!job.shard) check_extension(job.output, written);
  check_writable(job.output);
  return job;
}

SceneRenderer make_renderer(const Scene& scene, const RenderOptions& options,
                            const std::vector<std::string>& channels) {
  const AovRequest aovs = parse_aovs(channels);
  const bool alone = is_ssao_alone(scene);
  options.device.prepare(!alone);
  if (alone) limit_driver_threads(options.device.threads);
  SceneRendererOptions made;
  made.threads = options.device.threads;
  made.surface = aovs.needs_surface();
  made.attributes = needed_attributes(scene, alone ? aovs.normal : made.surface);
  SceneRenderer renderer(
      scene, [device = options.device] { return device.open(); }, std::move(made));
  warn_of(scene, renderer.mesh(), Viewer::camera);
  return renderer;
}

}  // namespace nook
