// nook_bench ssao: how far screen-space AO is from ray-traced AO with the same radius, weighting and normals,
// and what each method costs; and what the path tracer reaches in the same time.
#include "ssao.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "film/png.hpp"
#include "mesh/obj_loader.hpp"
#include "record.hpp"
#include "render/path_tracer.hpp"
#include "scene/names.hpp"
#include "scene/scene_toml.hpp"
#include "ssao/ssao.hpp"
#include "ssao_reference.hpp"

namespace nook::bench {
namespace {

using Method = SsaoSettings::Method;
using Quality = SsaoSettings::Quality;

struct Settings {
  std::vector<std::string> scenes = {"bunny", "bunny-alone", "fence", "cornell", "spaceship", "room"};
  std::vector<std::string> radii = {"0.15", "half"};
  int width = 1280, height = 720, frames = 3, grid = 23;
  bool equal_time = true;
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
  if (found == files.end()) throw Error(ExitCode::usage, "--scenes: unknown scene '" + name + "'");
  return load_scene(std::string(NOOK_SOURCE_DIR) + "/scenes/" + found->second + ".toml");
}

// One pixel in each 4x4 block, at a place that varies: as good as all pixels to 1 %, for a sixteenth of the
// rays.
std::vector<std::uint32_t> compared_pixels(int width, int height) {
  std::vector<std::uint32_t> pixels;
  std::uint32_t state = 12345;
  for (int y = 0; y + 3 < height; y += 4)
    for (int x = 0; x + 3 < width; x += 4) {
      state = state * 1664525u + 1013904223u;
      pixels.push_back(std::uint32_t(y + int(state >> 24 & 3)) * std::uint32_t(width) +
                       std::uint32_t(x + int(state >> 28 & 3)));
    }
  return pixels;
}

struct Reference {
  int width, height;
  std::vector<std::uint32_t> pixels;
  std::vector<PrimaryHit> hits;
  std::vector<ReferenceTracer::Estimate> ambient;
};

// Sums of the differences a - b over some pixels, b the reference.
struct Differences {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0, absolute = 0, variance = 0;
  void add(double value, const ReferenceTracer::Estimate& reference) {
    const double r = reference.value;
    n += 1, a += value, b += r, aa += value * value, bb += r * r, ab += value * r;
    absolute += std::abs(value - r);
    variance += reference.variance;
  }
  double bias() const { return (a - b) / n; }
  double mae() const { return absolute / n; }
  double rmse() const { return std::sqrt(std::max(0.0, (aa - 2 * ab + bb - variance) / n)); }
  double correlation() const { return (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b)); }
};

struct Errors {
  Differences all, inner,
      border;  // the border: within a sixteenth of the image's width or height of its edge
};

template <class Value>
Errors errors_of(const Reference& reference, Value value) {
  Errors errors;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!reference.hits[i].hit) continue;
    const int x = int(reference.pixels[i]) % reference.width, y = int(reference.pixels[i]) / reference.width;
    const bool border = std::min(x, reference.width - 1 - x) < reference.width / 16 ||
                        std::min(y, reference.height - 1 - y) < reference.height / 16;
    const double v = value(reference.pixels[i]);
    errors.all.add(v, reference.ambient[i]);
    (border ? errors.border : errors.inner).add(v, reference.ambient[i]);
  }
  return errors;
}

nlohmann::json json_of(const Errors& e) {
  return {{"rmse", e.all.rmse()},         {"mae", e.all.mae()},
          {"bias", e.all.bias()},         {"correlation", e.all.correlation()},
          {"rmse_inner", e.inner.rmse()}, {"rmse_border", e.border.rmse()}};
}

struct Variant {
  Method method;
  std::optional<Quality> quality;  // unset: the assignment
};

std::vector<Variant> variants() {
  std::vector<Variant> all = {{Method::point, std::nullopt}};
  for (const Method method : {Method::point, Method::gtao, Method::march})
    for (const Quality quality : {Quality::draft, Quality::real_time, Quality::accurate})
      all.push_back({method, quality});
  return all;
}

// The path tracer with `directions` directions a pixel: seconds of the fastest of three runs, and its films.
std::pair<double, Film> trace(const Device& device, const Scene& scene, const TriangleMesh& mesh,
                              const Bvh& bvh, float radius, std::uint32_t directions) {
  Scene traced = scene;
  traced.effects = {Effect{}};
  traced.effects[0].max_distance = {DistanceLimit::Kind::value, radius};
  traced.spp = 1;
  traced.directions = directions;
  const Plan plan = make_plan(traced, mesh);
  const std::vector<std::uint32_t> pixels = pixels_in_order(plan.window, plan.width);
  PathTracer tracer(device, plan, mesh, bvh);
  double best = std::numeric_limits<double>::infinity();
  Film film;
  for (int round = 0; round < 3; ++round) {
    std::vector<Film> films = tracer.make_films();
    const auto start = std::chrono::steady_clock::now();
    tracer.accumulate(pixels, {0, directions}, films);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    film = std::move(films.front());
  }
  return {best, std::move(film)};
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

void run_scene(const Settings& s, const std::string& name) {
  Scene scene = bench_scene(name);
  scene.width = s.width;
  scene.height = s.height;
  const TriangleMesh mesh = load_obj(scene.mesh_file);
  const Camera camera = resolve_camera(scene, mesh.bounds);
  const ReferenceTracer tracer(mesh);
  SsaoRenderer renderer(mesh);
  std::optional<Device> device;
  Bvh bvh;
  if (s.equal_time) {
    device.emplace(select_device(""));
    bvh = build_bvh(mesh);
  }
  for (const std::string& radius_text : s.radii) {
    const float radius =
        radius_text == "half" ? 0.5f * mesh.bounds.bounding_radius() : std::stof(radius_text);
    Reference reference{s.width, s.height, compared_pixels(s.width, s.height), {}, {}};
    reference.hits = tracer.primary(camera, s.width, s.height, reference.pixels);
    reference.ambient = tracer.ambient(reference.hits, radius, s.grid, 1);
    double seconds_per_direction = 0;
    if (device) seconds_per_direction = trace(*device, scene, mesh, bvh, radius, 16).first / 16;
    std::printf("%s, radius %.4g (%s), %zu triangles, %dx%d\n", name.c_str(), double(radius),
                radius_text.c_str(), mesh.triangles.size(), s.width, s.height);
    std::printf("%-16s %7s %7s %8s %6s %7s %7s %8s %6s %14s\n", "method", "RMSE", "MAE", "bias", "corr",
                "inner", "border", "ms", "fps", "traced, RMSE");
    for (const Variant& variant : variants()) {
      SsaoSettings settings;
      settings.method = variant.method;
      settings.quality = variant.quality;
      settings.radius = radius;
      const SsaoPlan plan = plan_ssao(settings, mesh.bounds);
      SsaoFrame frame = renderer.render(camera, plan, s.width, s.height);
      nlohmann::json passes;
      double seconds = frame.seconds;
      for (int i = 1; i < s.frames && frame.seconds < 5; ++i) {
        SsaoFrame again = renderer.render(camera, plan, s.width, s.height);
        if (again.seconds < seconds) frame = std::move(again);
        seconds = std::min(seconds, frame.seconds);
      }
      for (const SsaoTiming& timing : frame.timings) passes[timing.pass] = timing.seconds;
      const Errors errors = errors_of(reference, [&](std::uint32_t pixel) { return frame.occlusion[pixel]; });
      const std::string label = std::string(name_of(variant.method)) + "/" +
                                (variant.quality ? std::string(name_of(*variant.quality)) : "assigned");
      nlohmann::json record = {{"bench", "ssao"},
                               {"scene", name},
                               {"triangles", mesh.triangles.size()},
                               {"radius", radius},
                               {"radius_rule", radius_text},
                               {"width", s.width},
                               {"height", s.height},
                               {"variant", label},
                               {"seconds", seconds},
                               {"passes", passes},
                               {"device", renderer.device()},
                               {"errors", json_of(errors)}};
      std::string traced = "";
      if (device) {
        const auto directions = std::uint32_t(std::clamp(seconds / seconds_per_direction, 1.0, 4096.0));
        const Film film = trace(*device, scene, mesh, bvh, radius, directions).second;
        const Errors of_film = errors_of(reference, [&](std::uint32_t pixel) { return film.value(pixel); });
        record["equal_time"] = {{"directions", directions}, {"rmse", of_film.all.rmse()}};
        char text[40];
        std::snprintf(text, sizeof text, "%u, %.4f", directions, of_film.all.rmse());
        traced = text;
      }
      std::printf("%-16s %7.4f %7.4f %+8.4f %6.3f %7.4f %7.4f %8.1f %6.1f %14s\n", label.c_str(),
                  errors.all.rmse(), errors.all.mae(), errors.all.bias(), errors.all.correlation(),
                  errors.inner.rmse(), errors.border.rmse(), 1e3 * seconds, 1 / seconds, traced.c_str());
      std::fflush(stdout);
      append_record(s.output, record);
      if (!s.pictures.empty() && variant.quality != Quality::draft) {
        std::string file = label;
        std::replace(file.begin(), file.end(), '/', '_');
        save_comparison(s.pictures + "/" + name + "_" + radius_text + "_" + file + ".png", tracer, camera,
                        frame, radius);
      }
    }
  }
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
  command->add_flag("--equal-time,!--no-equal-time", settings->equal_time,
                    "Also what the path tracer reaches in that time");
  command->add_option("-o,--output", settings->output, "Append JSON lines to this file");
  command->add_option("--pictures", settings->pictures,
                      "Write reference, SSAO and error side by side to this folder");
  command->callback([settings] {
    for (const std::string& scene : settings->scenes) run_scene(*settings, scene);
  });
}

}  // namespace nook::bench
