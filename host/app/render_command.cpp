// nook render SCENE: a scene in, an EXR (and a PNG preview) out.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>

#include "app/checkpoints.hpp"
#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/scene_options.hpp"
#include "app/ssao_draw.hpp"
#include "app/ssao_render.hpp"
#include "app/target_options.hpp"
#include "app/turntable.hpp"
#include "base/error.hpp"
#include "base/libraries.hpp"
#include "base/memory.hpp"
#include "bvh/bvh.hpp"
#include "film/checkpoint.hpp"
#include "film/exr.hpp"
#include "film/png.hpp"
#include "mesh/mesh_analysis.hpp"
#include "render/denoise_picture.hpp"
#include "render/layers.hpp"
#include "render/path_tracer.hpp"
#include "render/picture.hpp"
#include "render/scene_mesh.hpp"
#include "render/session.hpp"
#include "report/run_record.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  SceneOptions scene;
  DeviceOptions device;
  CheckpointOptions checkpoints;
  TargetOptions target;
  fs::path output, stats;
  std::string progress = "auto";
  std::vector<std::string> aovs;
  unsigned frames = 1;
  unsigned turntable = 0;  // pictures along a turn; 0: one picture
  bool png = true, quiet = false, print_config = false, denoise = false;
};

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

// The output's folder is tried before the work, not after it.
void check_writable(const fs::path& file) {
  std::error_code code;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    throw Error(ExitCode::output,
                fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
  if (fs::is_directory(file, code))
    throw Error(ExitCode::output, fmt::format("{}: is a folder", file.string()));
  if (access(folder.c_str(), W_OK) != 0)
    throw Error(ExitCode::output,
                fmt::format("{}: the folder {} is not writable", file.string(), folder.string()));
}

// A film has 28 bytes a pixel and effect; render order, pixel list and positions 4 each; the picture 4 a
// channel, held twice when it is written, and up to three channels an effect or AOV.
void check_memory(const Scene& scene, std::size_t aovs) {
  const PixelRect window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  const std::uint64_t pixels = std::uint64_t(window.width()) * std::uint64_t(window.height());
  const std::uint64_t bytes_a_pixel =
      28 * scene.effects.size() + 12 + 2 * 4 * 3 * (scene.effects.size() + aovs);
  nook::check_memory(pixels * bytes_a_pixel,
                     fmt::format("a picture of {}x{} pixels", window.width(), window.height()),
                     "render it in pieces with --crop");
}

// One file for each output: the last one written would replace the others.
void check_outputs(const RenderOptions& options) {
  std::vector<fs::path> files;
  for (const fs::path& file : {options.output, options.stats, options.checkpoints.checkpoint})
    if (!file.empty()) files.push_back(fs::absolute(file).lexically_normal());
  std::sort(files.begin(), files.end());
  const auto twice = std::adjacent_find(files.begin(), files.end());
  if (twice != files.end())
    throw Error(ExitCode::usage, fmt::format("{}: two outputs cannot share a file", twice->string()));
  if (options.png && options.output.extension() == ".png")
    throw Error(ExitCode::usage, fmt::format("{}: is the preview's name; name an .exr file, or say --no-png",
                                             options.output.string()));
}

// Options that this scene cannot honour, and those that exclude one another; before anything is loaded.
void check_combinations(const Scene& scene, const RenderOptions& options) {
  const auto any = [&](auto kind) {
    return std::any_of(scene.effects.begin(), scene.effects.end(),
                       [&](const Effect& e) { return kind(e.kind); });
  };
  const bool sampled = any(is_traced);
  const bool screen_space = any([](EffectKind kind) { return kind == EffectKind::ssao; });
  const bool shard = options.checkpoints.share().has_value();
  const bool kept = shard || options.checkpoints.resume ||
                    !options.checkpoints.file(options.scene.scene, options.output).empty();
  const auto fail = [](const char* why) { throw Error(ExitCode::usage, why); };
  if (!sampled && options.target.any()) fail("--error, --time: the scene has no effect with samples");
  if (!sampled && options.denoise) fail("--denoise: the scene has no effect with samples");
  if (scene.denoise && shard)
    fail("--denoise, --shard: a share of a picture is not denoised; render it whole, or leave denoise out");
  if (!sampled && kept) fail("--checkpoint, --resume, --shard: the scene has no effect with samples to keep");
  if (screen_space && shard)
    fail("--shard: a screen-space layer cannot be merged; render it with a scene of its own");
  if (options.target.error && kept)
    fail("--error: a render to an error is not kept in parts (--checkpoint, --shard)");
  if (options.target.seconds && shard)
    fail("--time: a share of a picture (--shard) has a fixed number of samples");
}

std::string distance_text(const EffectPlan& effect) {
  return std::isinf(effect.max_distance) ? "unlimited"
                                         : fmt::format("{:.6g} world units", effect.max_distance);
}

void announce(const Plan& plan, const RunRecord& record) {
  for (const EffectPlan& effect : plan.effects)
    fmt::print(stderr, "{} {}x{}, {} triangles, {} spp x {} directions, {}, {}, distance {}, {}\n",
               name_of(effect.effect.kind), plan.window.width(), plan.window.height(), record.triangles,
               plan.spp, plan.directions, name_of(effect.effect.sampling), name_of(plan.sampler),
               distance_text(effect), record.device.name);
}

void announce_end(const RunRecord& r, const fs::path& output) {
  fmt::print(stderr,
             "{}: load {:.2f} s, tree {:.2f} s, kernels {:.2f} s{}, render {:.2f} s ({:.1f} Mrays/s), write "
             "{:.2f} s\n",
             output.string(), r.seconds.load, r.seconds.bvh, r.seconds.compile,
             r.kernels_from_cache ? " (cached)" : "", r.seconds.render,
             double(r.counts.camera_rays + r.counts.occlusion_rays) / std::max(r.seconds.render, 1e-9) * 1e-6,
             r.seconds.write);
  if (r.counts.rejected)
    fmt::print(stderr, "warning: {} samples were not finite and were left out\n", r.counts.rejected);
}

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

// A part that can be continued, less what only its end knows.
FilmPart::Texts as_texts(const std::map<std::string, std::string>& metadata) {
  return {metadata.begin(), metadata.end()};
}

// Runs the session to the end of its share, keeping its part on disk. Whatever ends it early, what is
// finished stays.
void run_session(Session& session, const SampleBox& share, const Session::Schedule& schedule,
                 Deadline deadline, CheckpointWriter& writer, ProgressMode mode) {
  const auto rays = [&] { return session.part().counts.camera_rays + session.part().counts.occlusion_rays; };
  const std::uint64_t held_before = session.samples_held(), rays_before = rays();
  ProgressReporter progress(mode, samples_in(subtract({share}, session.held())));
  bool finished = false, out_of_time = false;
  try {
    finished = session.run(schedule, [&] {
      progress.update(session.samples_held() - held_before, rays() - rays_before);
      writer.update(session);
      out_of_time = out_of_time || deadline.reached();  // asked once more, for the launch under way
      return !interrupted() && !out_of_time;
    });
  } catch (const Error& e) {
    progress.finish();
    writer.write(session);
    throw Error(e.code(), e.what() + writer.what_is_kept(session));
  }
  progress.finish();
  if (finished || (out_of_time && !interrupted())) return;
  writer.write(session);
  throw Error(ExitCode::interrupted, "interrupted" + writer.what_is_kept(session));
}

// Writes the picture (a shard has none yet) and the record.
void finish(const RenderOptions& options, const fs::path& output, Image& image, Stopwatch& watch,
            Stopwatch& whole, RunRecord& record) {
  if (!image.channels.empty()) {
    image.metadata = record.metadata();
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
  draw_ssao(scene, mesh, {}, options.frames, record, image);
  if (!options.quiet) announce_ssao(record);
}

// What the pictures of one run share: made by the first that needs it.
struct Loaded {
  std::optional<TriangleMesh> mesh;
  std::optional<Device> device;
  std::optional<Bvh> bvh;
};

int render(const Scene& scene, const RenderOptions& options, Loaded& loaded) {
  const AovRequest aovs = parse_aovs(options.aovs);
  options.target.check();
  const auto start = std::chrono::steady_clock::now();
  const ProgressMode asked = parse_progress(options.progress);
  const ProgressMode mode = options.quiet ? ProgressMode::none : asked;
  if (!options.stats.empty()) {
    keep_inputs(scene, options.stats);
    check_writable(options.stats);
  }
  check_outputs(options);
  check_combinations(scene, options);
  check_memory(scene, options.aovs.size());
  if (is_ssao_alone(scene)) {
    const fs::path file =
        options.output.empty() ? fs::path(options.scene.scene).replace_extension(".exr") : options.output;
    keep_inputs(scene, file);
    check_writable(file);
    return render_ssao(scene,
                       {options.scene.scene, file, options.stats, aovs, options.frames,
                        options.device.threads, options.png, options.quiet},
                       loaded.mesh);
  }
  const std::optional<Share> shard = options.checkpoints.share();
  CheckpointWriter writer(options.checkpoints.file(options.scene.scene, options.output),
                          options.checkpoints.every);
  if (!writer.file().empty()) check_writable(writer.file());
  const fs::path output = shard                    ? writer.file()
                          : options.output.empty() ? fs::path(options.scene.scene).replace_extension(".exr")
                                                   : options.output;
  keep_inputs(scene, output);
  check_writable(output);

  Stopwatch whole, watch;
  RunRecord record;
  record.scene_file = options.scene.scene.string();
  // Starting OpenCL takes longer than reading a small mesh, compiling about as long as building a tree.
  std::future<Device> opened;
  if (!loaded.device) opened = std::async(std::launch::async, [&] { return options.device.open(); });
  if (!loaded.mesh) loaded.mesh = load_scene_mesh(scene, needed_attributes(scene, aovs.needs_surface()));
  const TriangleMesh& mesh = *loaded.mesh;
  record.seconds.load = watch.lap();
  record.plan = options.target.plan_for(make_plan(scene, mesh, aovs.needs_surface()));
  record.triangles = mesh.triangles.size();
  if (!loaded.device) loaded.device.emplace(opened.get());
  const Device& device = *loaded.device;
  record.device = device.info();
  if (!options.quiet) announce(record.plan, record);
  watch.lap();
  std::future<PathTracer::Programs> programs =
      std::async(std::launch::async, [&] { return PathTracer::build_programs(device, record.plan); });
  if (!loaded.bvh) loaded.bvh = build_bvh(mesh, {.threads = options.device.threads});
  const Bvh& bvh = *loaded.bvh;
  record.seconds.bvh = watch.lap();
  PathTracer tracer(device, record.plan, mesh, bvh, kernel_source, Traversal::automatic, programs.get());
  record.seconds.compile = tracer.build_seconds();
  record.kernels_from_cache = tracer.all_from_cache();
  record.scene_hash = scene_hash(scene);
  record.mesh_hash = mesh_hash(mesh);

  if (options.target.dry_run) {
    print_forecast(tracer, record.plan, options.target);
    tracer.store_programs();
    return 0;
  }
  if (record.plan.effects.empty()) {
    Image image{record.plan.window.width(),
                record.plan.window.height(),
                channels_of_surface(record.plan, aovs, surface_under_pixels(tracer, record.plan)),
                {}};
    record.seconds.render = watch.lap();
    record.counts.camera_rays = tracer.counters().camera_rays;
    record.bytes_uploaded = device.bytes_uploaded();
    record.kernels_built = tracer.programs();
    add_ssao(scene, mesh, options, record, image);
    finish(options, output, image, watch, whole, record);
    tracer.store_programs();
    return 0;
  }

  Session session(tracer, record.plan,
                  film_identity(record.plan, record.device, record.scene_hash, record.mesh_hash));
  std::error_code code;
  if (options.checkpoints.resume && fs::exists(writer.file(), code))
    session.resume(read_film_part(writer.file()), writer.file().string());
  session.part().layers = layer_names(record.plan);
  session.part().aovs = options.aovs;
  session.part().metadata = as_texts(record.metadata());
  watch.lap();
  record.seconds.before_first_ray = whole.elapsed();

  catch_interrupts();
  const Deadline deadline(start, options.target.seconds);
  FilmPart& part = session.part();
  std::optional<AdaptiveRender> adaptive;
  AdaptiveResult result;
  if (options.target.error) {
    adaptive.emplace(tracer, record.plan, options.target.error_target());
    result = render_to_error(*adaptive, tracer, deadline, mode);
    part.render_seconds = watch.lap();
    const RenderCounters& counters = tracer.counters();
    part.counts = {counters.camera_rays, counters.occlusion_rays, counters.rejected};
    record.error = ErrorRecord{result.error_asked, options.target.target.confidence, result.error_reached,
                               result.error_worst, result.share_done};
    record.complete = result.met();
  } else {
    const SampleBox share = session.share(shard.value_or(Share{}));
    run_session(session, share, options.target.seconds ? doublings() : all_of(share), deadline, writer, mode);
    if (options.target.seconds) record.error = error_of(part.films);
  }
  const std::vector<SurfacePoint> surface = surface_under_pixels(tracer, record.plan);
  part.surface = channels_of_surface(record.plan, aovs, surface);
  watch.lap();

  record.counts = part.counts;
  record.launches = tracer.counters().launches;
  record.device_seconds = tracer.counters().device_seconds;
  record.seconds.render = part.render_seconds;
  record.bytes_uploaded = device.bytes_uploaded();
  record.kernels_built = tracer.programs();
  record.effect_rays = tracer.counters().effect_rays;
  part.metadata = as_texts(record.metadata());
  writer.write(session);
  Image image;
  if (!shard) {
    image = adaptive ? adaptive->picture(part, result) : make_picture(part);
    if (record.plan.denoise) denoise_picture(record.plan, part.films, surface, image);
    add_ssao(scene, mesh, options, record, image);
  }
  finish(options, output, image, watch, whole, record);
  tracer.store_programs();
  return record.error ? announce_error(*record.error, options.quiet) : 0;
}

// One picture after the other; the code is that of the worst.
int render_turntable(const Scene& scene, const RenderOptions& options) {
  if (options.checkpoints.resume || options.checkpoints.share() ||
      !options.checkpoints.file(options.scene.scene, options.output).empty())
    throw Error(ExitCode::usage,
                "--turntable: a turn is not kept in parts (--checkpoint, --resume, --shard)");
  if (options.target.dry_run) throw Error(ExitCode::usage, "--turntable: --dry-run forecasts one picture");
  const fs::path first =
      options.output.empty() ? fs::path(options.scene.scene).replace_extension(".exr") : options.output;
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
  loaded.mesh = load_scene_mesh(scene, needed_attributes(scene, surface));
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
  options->scene.add_to(*command);
  options->device.add_to(*command);
  options->checkpoints.add_to(*command);
  options->target.add_to(*command);
  command->add_option("-o,--output", options->output,
                      "EXR file; default: beside the scene, .exr for .toml. With --shard: the part's file");
  command->add_option("--aov", options->aovs, "More channels: normal,position,depth,variance,samples,alpha")
      ->delimiter(',');
  command->add_option("--progress", options->progress, "auto, plain, json or none (to stderr)")
      ->envname("NOOK_PROGRESS");
  command->add_option("--frames", options->frames, "SSAO: draw the frame so often, and report the fastest")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option(
          "--turntable", options->turntable,
          "Render so many pictures along a full turn of the eye about `at`: out_0000.exr, out_0001.exr, ...")
      ->check(CLI::Range(1, 100000));
  command->add_option("--stats", options->stats, "Write the run record as JSON");
  command->add_flag("--png,!--no-png", options->png,
                    "Write a PNG preview beside the EXR (sRGB encoded); on by default");
  command->add_flag("--denoise", options->denoise,
                    "Filter what is traced: less noise, some bias (docs/effects.md); off by default");
  command->add_flag("--quiet", options->quiet, "Say nothing but errors");
  command->add_flag("--print-config", options->print_config,
                    "Print the scene with every override and default, render nothing");
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace nook
