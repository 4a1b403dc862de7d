// nook render SCENE: a scene in, an EXR (and a PNG preview) out.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands.hpp"
#include "app/commands/render_job.hpp"
#include "app/commands/render_report.hpp"
#include "app/commands/turntable.hpp"
#include "app/interrupt.hpp"
#include "base/error.hpp"
#include "base/libraries.hpp"
#include "base/to_stderr.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "plan/framing.hpp"
#include "plan/scene_ground.hpp"
#include "render/picture_run.hpp"
#include "render/scene_renderer.hpp"
#include "report/run_record.hpp"
#include "scene/scene_writer.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

// What a part says of its run. It holds the samples before the denoiser, which `nook merge` does not run.
FilmPart::Texts as_texts(const RunRecord& record, const Scene& scene) {
  std::map<std::string, std::string> metadata = record.metadata();
  Scene undenoised = scene;
  undenoised.denoise = false;
  metadata["nook/scene"] = scene_attribute(undenoised);
  metadata.erase("nook/denoised");
  return {metadata.begin(), metadata.end()};
}

// What the renderer and the run have counted.
void record_counts(SceneRenderer& renderer, const PictureRun& run, RunRecord& record) {
  record.counts = run.counts();
  record.seconds.render = run.render_seconds();
  record.error = run.error();
  record.complete = run.complete();
  record.repeat = run.repeat();
  if (!record.plan.needs_opencl()) return;
  const OcclusionTracer& tracer = renderer.tracer();
  record.launches = tracer.counters().launches;
  record.device_seconds = tracer.counters().device_seconds;
  record.effect_rays = tracer.counters().effect_rays;
  record.bytes_uploaded = renderer.device().bytes_uploaded();
  record.kernels_built = tracer.programs();
}

void record_ssao(const SsaoLayers& layers, RunRecord& record) {
  record.ssao = layers.effects;
  record.seconds.ssao = layers.seconds;
  if (record.plan.needs_opencl()) return;
  record.device.name = layers.device;
  record.device.platform_name = "OpenGL";
  record.device.driver = layers.version;
  record.bytes_uploaded = layers.mesh_bytes;
}

// Writes the picture (a shard has none yet) and the record.
void finish(const Job& job, const Background& background, Image& image, RunRecord& record) {
  const RenderOptions& options = job.options;
  Stopwatch watch;
  if (!image.channels.empty()) {
    image.metadata = record.metadata();
    write_exr(job.output, image);
    if (options.png) write_png(fs::path(job.output).replace_extension(".png"), image, background);
  }
  record.seconds.write = watch.seconds();
  record.seconds.total = job.whole.seconds();
  record.libraries = mapped_libraries();
  if (!options.stats.empty()) write_stats(options.stats, record);
  if (!options.quiet) announce_end(record, job.output);
}

// Makes kernels and tree ready, or forecasts; what is then known goes into the record.
void get_ready(SceneRenderer& renderer, const Job& job, RunRecord& record) {
  record.device = renderer.device().info();
  if (!job.options.quiet) announce(record, renderer.scene().stop);
  if (!job.options.quiet && renderer.directions())
    to_stderr("directions chosen: {}\n", why(*renderer.directions()));
  const OcclusionTracer& tracer = renderer.tracer();
  record.seconds.bvh = renderer.seconds().bvh;
  record.seconds.compile = renderer.seconds().compile;
  record.kernels_from_cache = tracer.all_from_cache();
}

int render(SceneRenderer& renderer, const Job& job) {
  const RenderOptions& options = job.options;
  RunRecord record;
  record.scene_file = options.scene.scene.string();
  record.seconds.load = renderer.seconds().load;
  renderer.settle();
  record.plan = renderer.plan();
  record.triangles = renderer.mesh().scene_triangles();
  record.scene_hash = scene_hash(renderer.scene());
  record.folder = fs::absolute(job.output).lexically_normal().parent_path().string();
  check_mesh(renderer.scene(), job.origin.mesh_hash, renderer.mesh_hash());
  if (record.plan.needs_opencl()) get_ready(renderer, job, record);

  PictureRequest request;
  request.aovs = job.aovs;
  request.share = job.shard;
  request.part_file = job.part_file;
  request.seconds_between_parts = options.checkpoints.every.value_or(60);
  request.resume = options.checkpoints.resume;
  request.start = job.start;
  request.frames = options.frames.value_or(1);
  if (job.origin.again) request.camera_rays = job.origin.camera_rays;
  PictureRun run(renderer, std::move(request));
  record.repeat = run.repeat();
  run.set_metadata(as_texts(record, renderer.scene()));
  record.seconds.before_first_ray = job.whole.seconds();

  if (!record.plan.effects.empty()) catch_interrupts();
  TerminalObserver observer(job.progress);
  run.take(observer);
  record_counts(renderer, run, record);
  run.set_metadata(as_texts(record, renderer.scene()));
  run.keep();
  Image image;
  if (!job.shard) {
    const Stopwatch drawing;
    image = run.image();
    record_ssao(run.ssao(), record);
    if (!record.plan.needs_opencl()) record.seconds.render = drawing.seconds();
    if (!options.quiet) announce_ssao(record);
  }
  finish(job, renderer.scene().background, image, record);
  if (record.plan.needs_opencl()) renderer.tracer().store_programs();
  return record.error ? announce_error(*record.error, options.quiet) : 0;
}

int forecast_only(SceneRenderer& renderer, const Job& job) {
  RunRecord record;
  renderer.set_plan(plan_to_forecast(renderer.scene().stop, renderer.plan()));
  renderer.settle();
  record.plan = renderer.plan();
  record.triangles = renderer.mesh().scene_triangles();
  get_ready(renderer, job, record);
  print_forecast(renderer.tracer(), record.plan, renderer.scene().stop);
  renderer.tracer().store_programs();
  return 0;
}

std::vector<Camera> turn_of(const Scene& scene, const TriangleMesh& mesh, unsigned count) {
  if (scene.automatic_camera) return framing_turn(scene, mesh, count);
  std::vector<Camera> cameras;
  for (unsigned i = 0; i < count; ++i) cameras.push_back(turned_camera(scene.camera, i, count));
  return cameras;
}

// One picture after the other; the code is that of the worst.
int render_turntable(const Scene& scene, const RenderOptions& options) {
  if (options.checkpoints.resume || options.checkpoints.share() ||
      !options.checkpoints.file(options.scene.scene, options.output).empty())
    throw Error(ErrorKind::usage,
                "--turntable: a turn is not kept in parts (--checkpoint, --resume, --shard)");
  if (options.target.dry_run) throw Error(ErrorKind::usage, "--turntable: --dry-run forecasts one picture");
  const fs::path first = options.picture_file();
  const auto picture = [&](unsigned index) {
    RenderOptions one = options;
    one.output = numbered_file(first, index, options.turntable);
    one.stats = numbered_file(options.stats, index, options.turntable);
    return one;
  };
  for (unsigned i = 0; i < options.turntable; ++i) {
    Scene copy = scene;
    checked(copy, picture(i));
  }
  Scene still = scene;
  still.stop = options.check(scene);
  SceneRenderer renderer = make_renderer(still, options, options.aovs);
  const std::vector<Camera> cameras = turn_of(scene, renderer.mesh(), options.turntable);
  int worst = 0;
  for (unsigned i = 0; i < options.turntable; ++i) {
    Scene turned = scene;
    turned.automatic_camera = false;
    turned.camera = cameras[i];
    if (scene.ground) turned.ground = settled_ground(renderer.mesh());
    const RenderOptions one = picture(i);
    const Job job = checked(turned, one);
    SceneRenderer view(renderer, turned);
    worst = std::max(worst, render(view, job));
  }
  return worst;
}

int render(const RenderOptions& options) {
  Scene scene = options.scene.load();
  scene.denoise = scene.denoise || options.denoise;
  if (options.print_config) {
    scene.stop = options.check(scene);
    fmt::print("{}", to_toml(scene));
    return 0;
  }
  if (options.turntable > 0) return render_turntable(scene, options);
  const Job job = checked(scene, options);
  SceneRenderer renderer = make_renderer(scene, options, job.aovs);
  return options.target.dry_run ? forecast_only(renderer, job) : render(renderer, job);
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to an EXR and a PNG preview");
  options->add_to(*command);
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace nook
