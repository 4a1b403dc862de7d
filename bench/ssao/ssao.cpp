// nook_bench ssao: how far screen-space AO is from ray-traced AO with the same radius, weighting and normals,
// and what each method costs; and what traced rays reach in the same time.
#include "bench/ssao/ssao.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "bench/ssao/ssao_equal_time.hpp"
#include "bench/ssao/ssao_errors.hpp"
#include "bench/support/record.hpp"
#include "image/png.hpp"
#include "mesh/obj_loader.hpp"
#include "plan/plan.hpp"
#include "plan/scene_camera.hpp"
#include "scene/names.hpp"
#include "scene/scene_toml.hpp"
#include "ssao/ssao.hpp"

namespace nook::bench {
namespace {

using Method = SsaoSettings::Method;
using Quality = SsaoSettings::Quality;

struct Settings {
  std::vector<std::string> scenes = {"bunny", "bunny-alone", "fence", "cornell", "spaceship", "room"};
  std::vector<std::string> radii = {"0.15", "half"};
  std::vector<std::string> methods;  // labels of variants; empty: all
  int width = 1280, height = 720, frames = 3, grid = 23;
  bool reference = true, equal_time = false;
  std::string output, pictures;
};

// The shipped scenes, and the bunny of glmark2-data without the plane: there the half radius is the bunny's
// own.
Scene bench_scene(const std::string& name) {
  if (name == "bunny-alone") return scene_of_mesh("/usr/share/glmark2/models/bunny.obj");
  static const std::map<std::string, std::string> files = {{"bunny", "bunny_ao"},
                                                           {"fence", "fence_ao"},
                                                           {"cornell", "cbox_ssao"},
                                                           {"spaceship", "spaceship_ssao"},
                                                           {"room", "room_ao"}};
  const auto found = files.find(name);
  if (found == files.end()) throw Error(ErrorKind::usage, "--scenes: unknown scene '" + name + "'");
  return load_scene(std::string(NOOK_SOURCE_DIR) + "/scenes/" + found->second + ".toml");
}

struct Variant {
  std::string label;
  Method method;
  std::optional<Quality> quality;  // unset: the assignment
};

std::vector<Variant> variants(const Settings& s) {
  std::vector<Variant> all = {{"point/assigned", Method::point, std::nullopt}};
  for (const Method method : {Method::point, Method::gtao, Method::march})
    for (const Quality quality : {Quality::draft, Quality::real_time, Quality::accurate})
      all.push_back({std::string(name_of(method)) + "/" + std::string(name_of(quality)), method, quality});
  if (s.methods.empty()) return all;
  std::vector<Variant> chosen;
  for (const std::string& label : s.methods) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.label == label; });
    if (found == all.end()) throw Error(ErrorKind::usage, "--methods: unknown '" + label + "'");
    chosen.push_back(*found);
  }
  return chosen;
}

struct Timed {
  SsaoFrame frame;  // the fastest
  double median_seconds = 0;
  double cpu_seconds = 0;  // least of all frames
};

// The first frame compiles and is not counted. Slow methods are drawn twice in all.
Timed draw(SsaoRenderer& renderer, const Camera& camera, const SsaoPlan& plan, const Settings& s) {
  renderer.render(camera, plan, s.width, s.height);
  Timed timed;
  std::vector<double> seconds;
  for (int i = 0; i < s.frames && (i == 0 || seconds.front() < 2); ++i) {
    SsaoFrame frame = renderer.render(camera, plan, s.width, s.height);
    double cpu = 0;
    for (const SsaoTiming& timing : frame.timings) cpu += timing.cpu_seconds;
    timed.cpu_seconds = i == 0 ? cpu : std::min(timed.cpu_seconds, cpu);
    seconds.push_back(frame.seconds);
    if (i == 0 || frame.seconds < timed.frame.seconds) timed.frame = std::move(frame);
  }
  timed.median_seconds = median(seconds);
  return timed;
}

void save_picture(const std::string& path, int width, int height, const std::vector<float>& values) {
  Image image;
  image.width = width;
  image.height = height;
  for (const char* channel : {"R", "G", "B"}) image.channels.push_back({channel, values});
  write_png(path, image);
}

// Reference, SSAO and signed error (gray: equal; brighter: too open; 4 times enlarged) side by side.
void save_comparison(const std::string& path, const ReferenceTracer& tracer, const Camera& camera,
                     const SsaoFrame& frame, float radius) {
  const int w = frame.width, h = frame.height;
  std::vector<std::uint32_t> pixels(std::size_t(w) * std::size_t(h));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = std::uint32_t(i);
  const auto ambient = tracer.ambient(tracer.primary(camera, w, h, pixels), radius, 12, 2);
  std::vector<float> values(3 * pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    float* row = &values[3 * std::size_t(w) * (i / std::size_t(w)) + i % std::size_t(w)];
    row[0] = ambient[i].value;
    row[w] = frame.occlusion[i];
    row[2 * w] = 0.2140f + (frame.coverage[i] > 0 ? 2 * (frame.occlusion[i] - ambient[i].value) : 0.0f);
  }
  save_picture(path, 3 * w, h, values);
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

// What traced rays reach in the time of one method, first without the filter on either side, then with
// the same filter on both; `filter_seconds` is what it costs on a full picture.
nlohmann::json equal_time(const Settings& s, SsaoRenderer& renderer, const Camera& camera, SsaoPlan plan,
                          const TracedAo& traced, const Reference& reference,
                          const std::vector<PrimaryHit>& hits, double filter_seconds) {
  nlohmann::json record;
  const SsaoPlan filtered = plan;
  plan.denoise_radius = 0;
  for (const bool filter : {false, true}) {
    const Timed ssao = draw(renderer, camera, filter ? filtered : plan, s);
    TracedAo::Result rays = traced.in_time(ssao.frame.seconds - (filter ? filter_seconds : 0));
    if (filter)
      rays.values =
          edge_aware_blur(camera, s.width, s.height, hits, std::move(rays.values), 2, plan.depth_tolerance);
    const auto rmse = [&](const std::vector<float>& values) {
      return errors_of(reference, [&](std::uint32_t pixel) { return values[pixel]; }).all.rmse();
    };
    const double seconds = rays.seconds + (filter ? filter_seconds : 0);
    record[filter ? "filter" : "no_filter"] = {{"ssao_seconds", ssao.frame.seconds},
                                               {"ssao_rmse", rmse(ssao.frame.occlusion)},
                                               {"directions", rays.directions},
                                               {"traced_seconds", seconds},
                                               {"traced_rmse", rmse(rays.values)}};
    std::printf("  equal time, %-10s SSAO %.4f in %.1f ms; traced %.4f with %u directions in %.1f ms\n",
                filter ? "filtered:" : "raw:", rmse(ssao.frame.occlusion), 1e3 * ssao.frame.seconds,
                rmse(rays.values), rays.directions, 1e3 * seconds);
  }
  return record;
}

void run_radius(const Settings& s, const std::string& name, const std::string& radius_text,
                const Scene& scene, const TriangleMesh& mesh, const ReferenceTracer& tracer,
                SsaoRenderer& renderer) {
  const float radius = radius_text == "half" ? 0.5f * mesh.bounds.bounding_radius() : std::stof(radius_text);
  const Camera camera = resolve_camera(scene, mesh);
  std::printf("%s, radius %.4g (%s), %zu triangles, %dx%d\n", name.c_str(), double(radius),
              radius_text.c_str(), mesh.triangles.size(), s.width, s.height);
  Reference reference;
  if (s.reference) reference = trace_reference(tracer, camera, s.width, s.height, radius, s.grid);
  std::optional<TracedAo> traced;
  std::vector<PrimaryHit> hits;
  double filter_seconds = 0;
  if (s.equal_time) {
    traced.emplace(scene, mesh, radius);
    std::vector<std::uint32_t> pixels(std::size_t(s.width) * std::size_t(s.height));
    for (std::uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = i;
    hits = tracer.primary(camera, s.width, s.height, pixels);
    SsaoSettings settings{.method = Method::march, .quality = Quality::draft};
    settings.radius = radius;
    SsaoPlan plan = plan_ssao(settings, mesh.bounds);
    plan.half_resolution = false;
    for (const SsaoTiming& timing : draw(renderer, camera, plan, s).frame.timings)
      if (timing.pass == "denoise") filter_seconds = timing.seconds;
  }
  std::printf("%-16s %7s %7s %8s %6s %7s %7s %8s %8s %6s %8s\n", "method", "RMSE", "MAE", "bias", "corr",
              "inner", "border", "ms", "median", "fps", "CPU ms");
  for (const Variant& variant : variants(s)) {
    SsaoSettings settings;
    settings.method = variant.method;
    settings.quality = variant.quality;
    settings.radius = radius;
    const SsaoPlan plan = plan_ssao(settings, mesh.bounds);
    const Timed timed = draw(renderer, camera, plan, s);
    const SsaoFrame& frame = timed.frame;
    nlohmann::json passes;
    for (const SsaoTiming& timing : frame.timings)
      passes[timing.pass] = {{"seconds", timing.seconds}, {"cpu_seconds", timing.cpu_seconds}};
    nlohmann::json record = {{"bench", "ssao"},
                             {"scene", name},
                             {"triangles", mesh.triangles.size()},
                             {"radius", radius},
                             {"radius_rule", radius_text},
                             {"width", s.width},
                             {"height", s.height},
                             {"variant", variant.label},
                             {"seconds", frame.seconds},
                             {"median_seconds", timed.median_seconds},
                             {"cpu_seconds", timed.cpu_seconds},
                             {"passes", passes},
                             {"load", load_average()},
                             {"device", renderer.device()}};
    std::printf("%-16s ", variant.label.c_str());
    if (s.reference) {
      const Errors errors = errors_of(reference, [&](std::uint32_t pixel) { return frame.occlusion[pixel]; });
      record["errors"] = json_of(errors);
      record["reference_directions"] = 2 * s.grid * s.grid;
      std::printf("%7.4f %7.4f %+8.4f %6.3f %7.4f %7.4f ", errors.all.rmse(), errors.all.mae(),
                  errors.all.bias(), errors.all.correlation(), errors.inner.rmse(), errors.border.rmse());
    } else {
      std::printf("%47s ", "");
    }
    std::printf("%8.1f %8.1f %6.1f %8.1f\n", 1e3 * frame.seconds, 1e3 * timed.median_seconds,
                1 / timed.median_seconds, 1e3 * timed.cpu_seconds);
    if (traced)
      record["equal_time"] = equal_time(s, renderer, camera, plan, *traced, reference, hits, filter_seconds);
    std::fflush(stdout);
    append_record(s.output, record);
    if (!s.pictures.empty()) {
      std::string file = variant.label;
      std::replace(file.begin(), file.end(), '/', '_');
      save_comparison(s.pictures + "/" + name + "_" + radius_text + "_" + file + ".png", tracer, camera,
                      frame, radius);
    }
  }
}

void run_scene(const Settings& s, const std::string& name) {
  Scene scene = bench_scene(name);
  scene.width = s.width;
  scene.height = s.height;
  const TriangleMesh mesh = load_obj(scene.mesh_file);
  const ReferenceTracer tracer(mesh);
  SsaoRenderer renderer(mesh);
  for (const std::string& radius : s.radii) run_radius(s, name, radius, scene, mesh, tracer, renderer);
}

}  // namespace

void add_ssao(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  CLI::App* command =
      app.add_subcommand("ssao", "Screen-space AO against ray-traced AO: error and time of every method");
  command->add_option("--scenes", settings->scenes, "bunny, bunny-alone, fence, cornell, spaceship, room")
      ->delimiter(',');
  command->add_option("--radii", settings->radii, "World units, or half: half the bounding radius")
      ->delimiter(',');
  command->add_option("--width", settings->width)->check(CLI::Range(16, 16384));
  command->add_option("--height", settings->height)->check(CLI::Range(16, 16384));
  command->add_option("--frames", settings->frames, "The fastest of so many counts")
      ->check(CLI::Range(1, 1000));
  command->add_option("--grid", settings->grid, "The reference has 2 GRID^2 directions a pixel")
      ->check(CLI::Range(4, 100));
  command->add_option("--methods", settings->methods, "Such as point/assigned, march/real-time; default: all")
      ->delimiter(',');
  command->add_flag("--reference,!--no-reference", settings->reference, "Errors as well as times");
  command->add_flag("--equal-time", settings->equal_time,
                    "Also what traced rays reach in the same time, without and with the filter");
  command->add_option("-o,--output", settings->output, "Append JSON lines to this file");
  command->add_option("--pictures", settings->pictures,
                      "Write reference, SSAO and error side by side to this folder");
  command->callback([settings] {
    if (settings->equal_time && !settings->reference)
      throw Error(ErrorKind::usage, "--equal-time: needs the reference");
    for (const std::string& scene : settings->scenes) run_scene(*settings, scene);
  });
}

}  // namespace nook::bench
