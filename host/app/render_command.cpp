// nook render SCENE: a scene in, an EXR (and a PNG preview) out.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <optional>

#include "app/checkpoints.hpp"
#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/loading.hpp"
#include "app/picture_scene.hpp"
#include "app/render_options.hpp"
#include "app/render_report.hpp"
#include "app/render_run.hpp"
#include "app/ssao_draw.hpp"
#include "app/ssao_render.hpp"
#include "app/turntable.hpp"
#include "base/error.hpp"
#include "base/libraries.hpp"
#include "bvh/bvh.hpp"
#include "film/checkpoint.hpp"
#include "film/exr.hpp"
#include "film/png.hpp"
#include "mesh/mesh_analysis.hpp"
#include "render/denoise_picture.hpp"
#include "render/layers.hpp"
#include "render/path_tracer.hpp"
#include "render/picture.hpp"
#include "render/session.hpp"
#include "render/tree_options.hpp"
#include "report/run_record.hpp"
#include "scene/scene_writer.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count();
  }
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::vector<std::uint32_t> row_major(const PixelRect& window, int width) {
  std::vector<std::uint32_t> pixels;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      pixels.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
  return pixels;
}

// One point at each pixel's centre, if anything is made of them.
std::vector<SurfacePoint> surface_under_pixels(PathTracer& tracer, const Plan& plan) {
  if (!plan.surface) return {};
  return tracer.surface_points(row_major(plan.window, plan.width));
}

// The channels that they give: AOVs and layers of type normal, position and depth.
std::vector<Channel> channels_of_surface(const Plan& plan, const AovRequest& aovs,
                                         const std::vector<SurfacePoint>& points) {
  if (!plan.surface) return {};
  std::vector<Channel> channels = surface_channels(plan, aovs, points);
  add_surface_layers(plan, points, channels);
  return channels;
}

// What a part says of its run. It holds the samples before the denoiser, which `nook merge` does not run.
FilmPart::Texts as_texts(const RunRecord& record, const Scene& scene) {
  std::map<std::string, std::string> metadata = record.metadata();
  Scene undenoised = scene;
  undenoised.denoise = false;
  metadata["nook/scene"] = scene_attribute(undenoised);
  metadata.erase("nook/denoised");
  return {metadata.begin(), metadata.end()};
}

// Writes the picture (a shard has none yet) and the record.
void finish(const RenderOptions& options, const fs::path& output, Image& image, Stopwatch& watch,
            Stopwatch& whole, RunRecord& record) {
  if (!image.channels.empty()) {
    image.metadata = record.metadata();
    place_crop(image, record.plan);
    write_exr(output, image);
    if (options.png) write_png(fs::path(output).replace_extension(".png"), image);
  }
  record.seconds.write = watch.lap();
  record.seconds.total = whole.lap();
  record.libraries = mapped_libraries();
  if (!options.stats.empty()) write_stats(options.stats, record);
  if (!options.quiet) announce_end(record, output);
}

// The layers of the screen-space effects beside the path-traced ones.
void add_ssao(const Scene& scene, const TriangleMesh& mesh, const RenderOptions& options, RunRecord& record,
              Image& image) {
  if (record.plan.ssao.empty()) return;
  draw_ssao(scene, mesh, {}, options.frames.value_or(1), record, image);
  if (!options.quiet) announce_ssao(record);
}

// A render and what it is made with.
struct Job {
  const RenderOptions& options;
  const Scene& scene;
  const TriangleMesh& mesh;
  const Device& device;
  const AovRequest& aovs;
  StopTarget stop;
  Deadline deadline;
  fs::path output;
  ProgressMode progress;
  std::optional<Share> shard;
  std::vector<std::uint32_t> camera_rays;  ///< of each pixel, of a picture made again; empty: all
};

// What the tracer and the device counted.
void record_counts(const Job& job, const PathTracer& tracer, const TraceCounts& counts, RunRecord& record) {
  record.counts = counts;
  record.launches = tracer.counters().launches;
  record.device_seconds = tracer.counters().device_seconds;
  record.effect_rays = tracer.counters().effect_rays;
  record.bytes_uploaded = job.device.bytes_uploaded();
  record.kernels_built = tracer.programs();
}

// No effect with samples: one camera ray a pixel.
void render_surface(const Job& job, PathTracer& tracer, RunRecord& record, Stopwatch& watch,
                    Stopwatch& whole) {
  const PixelRect& window = record.plan.window;
  Image image{window.width(),
              window.height(),
              channels_of_surface(record.plan, job.aovs, surface_under_pixels(tracer, record.plan)),
              {}};
  record.seconds.render = watch.lap();
  record_counts(job, tracer, {tracer.counters().camera_rays, 0, 0}, record);
  add_ssao(job.scene, job.mesh, job.options, record, image);
  finish(job.options, job.output, image, watch, whole, record);
}

// All of a share's samples, as many as the time allows, or those that the picture had.
void take_samples(const Job& job, Session& session, const RunControl& control) {
  const SampleBox share = session.share(job.shard.value_or(Share{}));
  Session::Schedule schedule = job.stop.seconds ? doublings() : all_of(share);
  SampleBoxes all{share};
  if (!job.camera_rays.empty()) all = (schedule = all_of_each(session, job.camera_rays))(session);
  run_schedule(session, schedule, samples_in(subtract(all, session.held())), control);
}

// What each pixel got, where its scene does not say it.
void add_camera_rays(const Job& job, Session& session, RunRecord& record, Image& image) {
  if (!job.stop.seconds) return;
  if (job.stop.error) {
    if (!record.complete) record.not_repeatable = "its time ended before its error was met";
    return;
  }
  if (has_first_samples(session))
    image.channels.push_back({camera_rays_channel, session.films().front().camera_samples});
  else
    record.not_repeatable = "its pixels have other samples than their first";
}

// Takes the samples and writes what they make; the exit code.
int render_samples(const Job& job, PathTracer& tracer, CheckpointWriter& writer, RunRecord& record,
                   Stopwatch& watch, Stopwatch& whole) {
  const RenderOptions& options = job.options;
  FilmPart::Texts of_rule;
  if (job.stop.error)
    of_rule = {{"error", fmt::format("{}", *job.stop.error)},
               {"confidence", fmt::format("{}", job.stop.confidence)},
               {"min_spp", std::to_string(job.stop.min_spp)}};
  FilmPart::Texts identity =
      film_identity(record.plan, record.device, record.scene_hash, record.mesh_hash, of_rule);
  std::optional<AdaptiveRender> adaptive;
  std::optional<Session> fixed;
  if (job.stop.error)
    adaptive.emplace(tracer, record.plan, error_target(job.stop), std::move(identity));
  else
    fixed.emplace(tracer, record.plan, std::move(identity));
  Session& session = adaptive ? adaptive->session() : *fixed;
  std::error_code code;
  if (options.checkpoints.resume && fs::exists(writer.file(), code))
    session.resume(read_film_part(writer.file()), writer.file().string());
  session.part().layers = layer_names(record.plan);
  session.part().aovs = record.aovs;
  session.part().metadata = as_texts(record, job.scene);
  watch.lap();
  record.seconds.before_first_ray = whole.elapsed();

  catch_interrupts();
  AdaptiveResult result;
  const RunControl control{tracer, writer, job.deadline, job.progress};
  if (adaptive) {
    result = run_to_error(*adaptive, control);
    record.error = ErrorRecord{result.error_asked, job.stop.confidence, result.error_reached,
                               result.error_worst, result.share_done};
    record.complete = result.met();
  } else {
    take_samples(job, session, control);
    if (job.stop.seconds) record.error = error_of(session.films());
  }
  FilmPart& part = session.part();
  const std::vector<SurfacePoint> surface = surface_under_pixels(tracer, record.plan);
  part.surface = channels_of_surface(record.plan, job.aovs, surface);
  watch.lap();

  record_counts(job, tracer, part.counts, record);
  record.seconds.render = part.render_seconds;
  part.metadata = as_texts(record, job.scene);
  writer.write(session);
  Image image;
  if (!job.shard) {
    image = adaptive ? adaptive->picture(part, result) : make_picture(part);
    if (record.plan.denoise) denoise_picture(record.plan, part.films, surface, image);
    add_camera_rays(job, session, record, image);
    add_ssao(job.scene, job.mesh, options, record, image);
  }
  finish(options, job.output, image, watch, whole, record);
  return record.error ? announce_error(*record.error, options.quiet) : 0;
}

// What the pictures of one run share: made by the first that needs it.
struct Loaded {
  std::optional<TriangleMesh> mesh;
  std::optional<Device> device;
  std::optional<Bvh> bvh;
};

// Where a picture is the scene: what it was made of. With overrides its scene makes another picture.
PictureOrigin origin_of(const RenderOptions& options) {
  if (!is_picture(options.scene.scene)) return {};
  PictureOrigin origin = origin_of_picture(options.scene.scene);
  const TargetOptions& target = options.target;
  origin.again = options.scene.given().empty() && !options.scene.size && options.scene.crop.empty() &&
                 !target.error && !target.seconds && !target.confidence && !target.min_spp &&
                 !target.max_spp && options.turntable == 0;
  if (origin.again && !origin.why_not.empty())
    throw Error(ExitCode::scene,
                fmt::format("{}: cannot be made again: {}; --print-config prints its scene, --spp renders it",
                            options.scene.scene.string(), origin.why_not));
  return origin;
}

int render(const Scene& scene, const RenderOptions& options, Loaded& loaded) {
  const double start = Deadline::steady_seconds();
  const PictureOrigin origin = origin_of(options);
  const std::vector<std::string> aov_names = options.aovs.empty() ? origin.aovs : options.aovs;
  const AovRequest aovs = parse_aovs(aov_names);
  const ProgressMode asked = parse_progress(options.progress);
  if (!options.stats.empty()) {
    keep_inputs(scene, options.stats);
    check_writable(options.stats);
  }
  const StopTarget stop = options.check(scene);
  check_memory(scene, aov_names.size(), stop.error ? largest_rule_bytes : 0);
  const bool only_screen_space = is_ssao_alone(scene);
  const std::optional<Share> shard = options.checkpoints.share();
  CheckpointWriter writer(options.checkpoints.file(options.scene.scene, options.output),
                          options.checkpoints.every.value_or(60));
  if (!writer.file().empty()) check_writable(writer.file());
  const fs::path output = shard ? writer.file() : options.picture_file();
  keep_inputs(scene, output);
  check_writable(output);
  if (only_screen_space)
    return render_ssao(scene,
                       {options.scene.scene, output, options.stats, aovs, aov_names, origin.mesh_hash,
                        options.frames.value_or(1), options.device.threads, options.png, options.quiet},
                       loaded.mesh);

  Stopwatch whole, watch;
  RunRecord record;
  record.scene_file = options.scene.scene.string();
  Scene resolved = scene;
  resolved.stop = stop;
  record_scene(resolved, aov_names, output, record);
  // Starting OpenCL takes longer than reading a small mesh, compiling about as long as building a tree.
  std::future<Device> opened;
  if (!loaded.device) options.device.prepare();
  if (!loaded.device) opened = std::async(std::launch::async, [&] { return options.device.open(); });
  if (!loaded.mesh)
    loaded.mesh = load_and_warn(scene, needed_attributes(scene, aovs.needs_surface()), scene.instancing);
  const TriangleMesh& mesh = *loaded.mesh;
  record.seconds.load = watch.lap();
  const Plan all = make_plan(scene, mesh, aovs.needs_surface());
  record.plan = options.target.dry_run ? plan_to_forecast(stop, all) : plan_until(stop, all);
  record.triangles = mesh.scene_triangles();
  if (!loaded.device) loaded.device.emplace(opened.get());
  const Device& device = *loaded.device;
  record.device = device.info();
  if (!options.quiet) announce(record, stop);
  watch.lap();
  const BvhOptions tree =
      tree_options(device.info(), record.plan, planned_rays(record.plan), options.device.threads);
  const unsigned width = loaded.bvh ? loaded.bvh->width() : tree.width;
  std::future<PathTracer::Programs> programs =
      std::async(std::launch::async, [&] { return PathTracer::build_programs(device, record.plan, width); });
  if (!loaded.bvh) loaded.bvh = build_bvh(mesh, tree);
  const Bvh& bvh = *loaded.bvh;
  record.seconds.bvh = watch.lap();
  PathTracer tracer(device, record.plan, mesh, bvh, kernel_source, Traversal::automatic, programs.get());
  record.seconds.compile = tracer.build_seconds();
  record.kernels_from_cache = tracer.all_from_cache();
  record.scene_hash = scene_hash(scene);
  record.mesh_hash = mesh_hash(mesh);
  check_mesh(scene, origin.mesh_hash, record.mesh_hash);

  // What is made again is known, and takes the time that it takes.
  const bool timed = stop.seconds && !origin.again;
  const Deadline deadline(timed ? std::optional(start + *stop.seconds) : std::nullopt);
  const ProgressMode progress = options.quiet ? ProgressMode::none : asked;
  const Job job{options,
                resolved,
                mesh,
                device,
                aovs,
                stop,
                deadline,
                output,
                progress,
                shard,
                origin.again ? origin.camera_rays : std::vector<std::uint32_t>()};
  int code = 0;
  if (options.target.dry_run)
    print_forecast(tracer, record.plan, stop);
  else if (record.plan.effects.empty())
    render_surface(job, tracer, record, watch, whole);
  else
    code = render_samples(job, tracer, writer, record, watch, whole);
  tracer.store_programs();
  return code;
}

// One picture after the other; the code is that of the worst.
int render_turntable(const Scene& scene, const RenderOptions& options) {
  if (options.checkpoints.resume || options.checkpoints.share() ||
      !options.checkpoints.file(options.scene.scene, options.output).empty())
    throw Error(ExitCode::usage,
                "--turntable: a turn is not kept in parts (--checkpoint, --resume, --shard)");
  if (options.target.dry_run) throw Error(ExitCode::usage, "--turntable: --dry-run forecasts one picture");
  const fs::path first = options.picture_file();
  const auto picture = [&](unsigned index) {
    RenderOptions one = options;
    one.output = numbered_file(first, index, options.turntable);
    one.stats = numbered_file(options.stats, index, options.turntable);
    return one;
  };
  for (unsigned i = 0; i < options.turntable; ++i) {
    const RenderOptions one = picture(i);
    for (const fs::path& file : {one.output, one.stats}) {
      if (file.empty()) continue;
      keep_inputs(scene, file);
      check_writable(file);
    }
  }
  Loaded loaded;
  const bool surface =
      is_ssao_alone(scene) ? parse_aovs(options.aovs).normal : parse_aovs(options.aovs).needs_surface();
  loaded.mesh = load_and_warn(scene, needed_attributes(scene, surface), scene.instancing);
  const Camera camera = resolve_camera(scene, loaded.mesh->subject_bounds());
  int worst = 0;
  for (unsigned i = 0; i < options.turntable; ++i) {
    Scene turned = scene;
    turned.automatic_camera = false;
    turned.camera = turned_camera(camera, i, options.turntable);
    worst = std::max(worst, render(turned, picture(i), loaded));
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
  Loaded loaded;
  return render(scene, options, loaded);
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to an EXR and a PNG preview");
  options->add_to(*command);
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace nook
