// nook render SCENE: a scene in, an EXR (and a PNG preview) out.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/scene_options.hpp"
#include "base/error.hpp"
#include "bvh/bvh.hpp"
#include "film/exr.hpp"
#include "film/png.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/obj_loader.hpp"
#include "render/path_tracer.hpp"
#include "render/picture.hpp"
#include "report/run_record.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  SceneOptions scene;
  DeviceOptions device;
  fs::path output, stats;
  std::string progress = "auto";
  std::vector<std::string> aovs;
  bool png = true, quiet = false, print_config = false;
};

class Stopwatch {
 public:
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
  if (!fs::is_directory(folder, code)) throw Error(ExitCode::output, fmt::format("{}: the folder {} does not exist", file.string(), folder.string()));
  if (fs::is_directory(file, code)) throw Error(ExitCode::output, fmt::format("{}: is a folder", file.string()));
  if (access(folder.c_str(), W_OK) != 0) throw Error(ExitCode::output, fmt::format("{}: the folder {} is not writable", file.string(), folder.string()));
}

std::string distance_text(const EffectPlan& effect) {
  return std::isinf(effect.max_distance) ? "unlimited" : fmt::format("{:.6g} world units", effect.max_distance);
}

void announce(const Plan& plan, const RunRecord& record) {
  for (const EffectPlan& effect : plan.effects)
    fmt::print(stderr, "{} {}x{}, {} triangles, {} spp x {} directions, {}, {}, distance {}, {}\n", name_of(effect.effect.kind),
               plan.window.width(), plan.window.height(), record.triangles, plan.spp, plan.directions, name_of(effect.effect.sampling),
               name_of(plan.sampler), distance_text(effect), record.device.name);
}

void announce_end(const RunRecord& r, const fs::path& output) {
  fmt::print(stderr, "{}: load {:.2f} s, tree {:.2f} s, kernels {:.2f} s{}, render {:.2f} s ({:.1f} Mrays/s), write {:.2f} s\n", output.string(),
             r.seconds.load, r.seconds.bvh, r.seconds.compile, r.kernels_from_cache ? " (cached)" : "", r.seconds.render,
             double(r.counters.camera_rays + r.counters.occlusion_rays) / std::max(r.seconds.render, 1e-9) * 1e-6, r.seconds.write);
  if (r.counters.rejected) fmt::print(stderr, "warning: {} samples were not finite and were left out\n", r.counters.rejected);
}

std::vector<std::uint32_t> row_major(const PixelRect& window, int width) {
  std::vector<std::uint32_t> pixels;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) pixels.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
  return pixels;
}

int render(const RenderOptions& options) {
  const Scene scene = options.scene.load();
  if (options.print_config) {
    fmt::print("{}", to_toml(scene));
    return 0;
  }
  const AovRequest aovs = parse_aovs(options.aovs);
  const ProgressMode mode = options.quiet ? ProgressMode::none : parse_progress(options.progress);
  const fs::path output = options.output.empty() ? fs::path(options.scene.scene).replace_extension(".exr") : options.output;
  check_writable(output);

  Stopwatch whole, watch;
  RunRecord record;
  record.scene_file = options.scene.scene.string();
  const TriangleMesh mesh = load_obj(scene.mesh_file);
  record.seconds.load = watch.lap();
  record.plan = make_plan(scene, mesh);
  record.triangles = mesh.triangles.size();
  const Device device = options.device.open();
  record.device = device.info();
  if (!options.quiet) announce(record.plan, record);
  watch.lap();
  const Bvh bvh = build_bvh(mesh);
  record.seconds.bvh = watch.lap();
  PathTracer tracer(device, record.plan, mesh, bvh);
  record.seconds.compile = tracer.build_seconds();
  record.kernels_from_cache = tracer.all_from_cache();
  watch.lap();

  catch_interrupts();
  std::vector<Film> films = tracer.make_films();
  ProgressReporter progress(mode, films.front().pixels() * std::uint64_t(record.plan.spp));
  const bool finished = tracer.accumulate(pixels_in_order(record.plan.window, record.plan.width), {0, record.plan.spp}, films, [&](std::uint64_t samples) {
    progress.update(samples, tracer.counters().camera_rays + tracer.counters().occlusion_rays);
    return !interrupted();
  });
  progress.finish();
  if (!finished) throw Error(ExitCode::interrupted, "interrupted; nothing was written");
  std::vector<SurfacePoint> surface;
  if (aovs.needs_surface()) surface = tracer.surface_points(row_major(record.plan.window, record.plan.width));
  record.seconds.render = watch.lap();

  record.counters = tracer.counters();
  record.bytes_uploaded = device.bytes_uploaded();
  record.scene_hash = scene_hash(scene);
  record.mesh_hash = mesh_hash(mesh);
  Image image = make_picture(record.plan, films, aovs, surface);
  image.metadata = record.metadata();
  write_exr(output, image);
  if (options.png) write_png(fs::path(output).replace_extension(".png"), image);
  record.seconds.write = watch.lap();
  record.seconds.total = whole.lap();
  if (!options.stats.empty()) write_stats(options.stats, record);
  if (!options.quiet) announce_end(record, output);
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to an EXR and a PNG preview");
  options->scene.add_to(*command);
  options->device.add_to(*command);
  command->add_option("-o,--output", options->output, "EXR file; default: beside the scene, .exr for .toml");
  command->add_option("--aov", options->aovs, "More channels: normal,position,depth,variance,samples,alpha")->delimiter(',');
  command->add_option("--progress", options->progress, "auto, plain, json or none (to stderr)")->envname("NOOK_PROGRESS");
  command->add_option("--stats", options->stats, "Write the run record as JSON");
  command->add_flag("--png,!--no-png", options->png, "Write a PNG preview beside the EXR (sRGB encoded); on by default");
  command->add_flag("--quiet", options->quiet, "Say nothing but errors");
  command->add_flag("--print-config", options->print_config, "Print the scene with every override and default, render nothing");
  command->callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace nook
