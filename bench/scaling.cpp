#include "scaling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>
#include <utility>

#include "base/driver_threads.hpp"
#include "base/embedded_file.hpp"
#include "base/error.hpp"
#include "bench/support/child.hpp"
#include "bench/support/record.hpp"
#include "bench/support/scene_files.hpp"
#include "bench/support/stopwatch.hpp"
#include "bvh/bvh.hpp"
#include "device/kernel_source.hpp"
#include "mesh/ply.hpp"
#include "plan/tree_options.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::bench {

namespace kernels {
extern const EmbeddedFile files[];  // occlusion.cl, moller_trumbore.cl
}

namespace {

struct Settings {
  unsigned rounds = 3, threads = 2;
  double most_triangles = 1e7;
  std::string part = "all";
  std::string output, options_output;
  bool cpu_time = false;
};

constexpr unsigned base_triangles = 1000000;

std::string knot(double triangles) {
  return "knot:" + std::to_string(std::size_t(triangles));
}

// ---- Whole processes: time and memory along one axis ----

class Sweep {
 public:
  explicit Sweep(const Settings& settings) : s_(settings) {}

  void use(const std::string& scene_name) {
    if (scene_name == scene_name_) return;
    scene_name_ = scene_name;
    BenchScene scene = bench_scene(scene_name);
    triangles_ = scene.mesh.triangles.size();
    // Without normals of its own a vertex shades with its triangle's.
    write_ply(files_ / "mesh.ply", scene.mesh, std::vector<vec3>(scene.mesh.positions.size(), vec3(0)), {});
    scene.mesh = {};
    scene_ = std::move(scene);
  }

  void measure(const char* axis, double value, const PictureSettings& picture, unsigned threads) {
    write_scene(files_ / "scene.toml", "mesh.ply", scene_, picture);
    const std::vector<std::string> command = {program_beside("nook"),
                                              "render",
                                              files_ / "scene.toml",
                                              "-o",
                                              files_ / "picture.exr",
                                              "--stats",
                                              files_ / "stats.json",
                                              "--threads",
                                              std::to_string(threads),
                                              "--no-png",
                                              "--quiet"};
    if (!std::exchange(kernels_in_cache_, true)) run_child(command);
    std::vector<double> seconds;
    nlohmann::json stats;
    double memory = 0;
    for (unsigned i = 0; i < s_.rounds; ++i) {
      const ChildTimes child = run_child(command);
      seconds.push_back(s_.cpu_time ? child.cpu_seconds : child.wall_seconds);
      memory = std::max(memory, child.peak_bytes);
      if (seconds.back() == *std::min_element(seconds.begin(), seconds.end())) {
        std::ifstream in(files_ / "stats.json");
        stats = nlohmann::json::parse(in);
      }
    }
    const nlohmann::json& stages = stats["seconds"];
    const double rays = stats["rays"]["camera"].get<double>() + stats["rays"]["occlusion"].get<double>();
    std::printf(
        "%-9s %10.0f: %7.3f s (load %.3f, tree %.3f, render %.3f, write %.3f), %6.0f MB, %5.1f Mrays/s\n",
        axis, value, median(seconds), stages["load"].get<double>(), stages["bvh"].get<double>(),
        stages["render"].get<double>(), stages["write"].get<double>(), memory * 1e-6,
        rays / stages["render"].get<double>() * 1e-6);
    append_record(s_.output, {{"bench", "scaling"},
                              {"axis", axis},
                              {"value", value},
                              {"triangles", triangles_},
                              {"resolution", picture.resolution},
                              {"directions", picture.directions},
                              {"threads", threads},
                              {"rounds", s_.rounds},
                              {"clock", s_.cpu_time ? "cpu" : "wall"},
                              {"seconds", median(seconds)},
                              {"stages", stages},
                              {"rays", rays},
                              {"peak_bytes", memory}});
  }

 private:
  const Settings& s_;
  TemporaryFolder files_;
  std::string scene_name_;
  BenchScene scene_;
  std::size_t triangles_ = 0;
  bool kernels_in_cache_ = false;
};

void run_sweeps(const Settings& s) {
  Sweep sweep(s);
  for (double triangles = 1e4; triangles <= s.most_triangles; triangles *= 10) {
    sweep.use(knot(triangles));
    sweep.measure("triangles", triangles, {512, 1, 16}, s.threads);
  }
  sweep.use(knot(base_triangles));
  for (const unsigned resolution : {256u, 512u, 1024u, 2048u})
    sweep.measure("pixels", double(resolution) * resolution, {resolution, 1, 16}, s.threads);
  for (const unsigned directions : {1u, 4u, 16u, 64u, 256u})
    sweep.measure("rays", directions, {512, 1, directions}, s.threads);
  const unsigned hardware = std::max(1u, std::thread::hardware_concurrency());
  for (unsigned threads = 1; threads <= hardware; threads *= 2)
    sweep.measure("threads", threads, {512, 1, 64}, threads);
}

// ---- In one process: what an option costs, against the same picture without it ----

struct Option {
  const char* name;
  std::function<void(Scene&)> change = [](Scene&) {};
  std::function<std::string(std::string)> kernels = [](std::string source) { return source; };
  Traversal traversal = Traversal::automatic;
  bool smooth = false, other_width = false, refined = false;
  double most_difference = 1;  ///< of the picture's mean from the base's, relative
};

/// bench/kernels/occlusion.cl with the triangle test of kernels/moller_trumbore.cl.
std::string not_watertight(std::string source) {
  const auto replace = [&](const std::string& find, const std::string& by) {
    const std::size_t at = source.find(find);
    if (at == std::string::npos) throw Error(ErrorKind::internal, "`" + find + "` is not in the kernels");
    source.replace(at, find.size(), by);
  };
  if (source.find("__kernel void occlusion(") == std::string::npos) return source;  // primary.cl
  const std::string place = "// A tree of one node:";
  const std::string test = kernels::files[1].text;
  replace(place, test.substr(test.find("//")) + place);  // less its include: the kernels have it
  const std::string loosely = "(near = 0, leaf_occludes_loosely(leaf, origins, d, k, max_distance))";
  replace("leaf_occludes(leaf, rays, k, &near)", loosely);
  replace("leaf_occludes(leaf, &rays, k, &near)", loosely);
  return source;
}

std::vector<Option> options(const char* other_width) {
  const auto sampler = [](Sampler chosen) { return [chosen](Scene& s) { s.sampler = chosen; }; };
  const auto effect = [](auto change) { return [change](Scene& s) { change(s.effects[0]); }; };
  return {{"base"},
          {.name = "smooth normals", .smooth = true},
          {"sampler independent", sampler(Sampler::independent)},
          {"sampler stratified", sampler(Sampler::stratified)},
          {"sampler halton", sampler(Sampler::halton)},
          {"sampler zorder", sampler(Sampler::zorder)},
          {"directions hemisphere", effect([](Effect& e) { e.sampling = Sampling::hemisphere; })},
          {"directions sphere", effect([](Effect& e) { e.sampling = Sampling::sphere; })},
          {"RO lobe, n = 30", effect([](Effect& e) {
             e.kind = EffectKind::ro;
             e.sampling = Sampling::lobe;
           })},
          {"bent normals", effect([](Effect& e) { e.kind = EffectKind::bent; })},
          {"falloff", effect([](Effect& e) {
             e.falloff = Falloff::smooth;
             e.max_distance = {DistanceLimit::Kind::value, 1.0f};
           })},
          {"distance 1", effect([](Effect& e) {
             e.max_distance = {DistanceLimit::Kind::value, 1.0f};
           })},
          {.name = "triangle test not watertight", .kernels = not_watertight, .most_difference = 1e-5},
          {.name = "portable path",
           .kernels = [](std::string source) { return "#define TRAVERSAL_PORTABLE 1\n" + source; },
           .most_difference = 0},
          {.name = other_width, .other_width = true, .most_difference = 0},
          {.name = "refined tree", .refined = true, .most_difference = 0},
          {.name = "one ray a work-item", .traversal = Traversal::scalar, .most_difference = 0}};
}

/// Vertex normals as the mean of the adjacent triangles'.
void add_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), vec3(0));
  for (const auto& t : mesh.triangles) {
    const vec3 n =
        glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
    for (const std::uint32_t i : t) mesh.normals[i] += n;
  }
  for (vec3& n : mesh.normals) n = glm::length(n) > 0 ? glm::normalize(n) : vec3(0, 1, 0);
  mesh.triangle_normals = mesh.triangles;
}

/// One option, ready to run.
struct Candidate {
  Plan plan;
  std::unique_ptr<OcclusionTracer> tracer;
  std::vector<double> seconds, ratios;
  double sum = 0;  ///< of the picture

  double run(const std::vector<std::uint32_t>& pixels) {
    std::vector<Film> films = tracer->make_films();
    const Stopwatch watch = started();
    tracer->accumulate(pixels, {0, plan.samples_per_pixel()}, films);
    const double spent = watch.seconds();
    sum = std::accumulate(films[0].sum.begin(), films[0].sum.end(), 0.0);
    return spent;
  }
};

void run_options(const Settings& s) {
  BenchScene bench = bench_scene(knot(base_triangles));
  TriangleMesh smooth = bench.mesh;
  add_normals(smooth);
  const Device device(select_device(""));
  const unsigned width = tree_width(device.info(), {});
  const Bvh bvh = build_bvh(bench.mesh, {.threads = s.threads, .width = width}),
            other = build_bvh(bench.mesh, {.threads = s.threads, .width = width == 16 ? 8u : 16u}),
            refined = build_bvh(bench.mesh, {.threads = s.threads, .width = width, .refined = true});
  Scene scene;
  scene.camera = {bench.eye, bench.at, vec3(0, 1, 0), bench.fov};
  scene.width = scene.height = 512;
  scene.directions = 16;
  scene.effects.resize(1);
  scene.effects[0].max_distance.kind = DistanceLimit::Kind::none;
  const std::vector<Option> all = options(width == 16 ? "8 children a node" : "16 children a node");
  std::vector<Candidate> candidates;
  for (const Option& option : all) {
    Scene changed = scene;
    option.change(changed);
    const TriangleMesh& mesh = option.smooth ? smooth : bench.mesh;
    Candidate& made = candidates.emplace_back();
    made.plan = make_plan(changed, mesh);
    const auto source = [&](const std::string& file) { return option.kernels(kernel_source(file)); };
    const Bvh& tree = option.other_width ? other : option.refined ? refined : bvh;
    made.tracer = std::make_unique<OcclusionTracer>(device, made.plan, mesh, tree, source, option.traversal);
  }
  const std::vector<std::uint32_t> pixels = pixels_in_order(candidates[0].plan.window, scene.width);
  for (Candidate& c : candidates) c.run(pixels);  // compiles, and touches memory
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::abs(candidates[i].sum / candidates[0].sum - 1) > all[i].most_difference)
      throw Error(ErrorKind::internal, std::string(all[i].name) + ": the picture is another one");
  for (unsigned i = 0; i < s.rounds; ++i)
    for (Candidate& c : candidates) {
      const double base = candidates[0].run(pixels);
      c.seconds.push_back(c.run(pixels));
      c.ratios.push_back(c.seconds.back() / base);
    }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Candidate& c = candidates[i];
    const auto [least, most] = std::minmax_element(c.ratios.begin(), c.ratios.end());
    std::printf("%-30s %7.3f s, %.2f of the base's time [%.2f, %.2f]\n", all[i].name, median(c.seconds),
                median(c.ratios), *least, *most);
    append_record(s.options_output, {{"bench", "options"},
                                     {"option", all[i].name},
                                     {"triangles", bench.mesh.triangles.size()},
                                     {"resolution", 512},
                                     {"directions", 16},
                                     {"threads", s.threads},
                                     {"rounds", s.rounds},
                                     {"clock", s.cpu_time ? "cpu" : "wall"},
                                     {"seconds", median(c.seconds)},
                                     {"time_ratio", median(c.ratios)},
                                     {"time_ratios", c.ratios}});
  }
}

void run(const Settings& s) {
  if (s.cpu_time) measured = Stopwatch::Of::threads;
  limit_driver_threads(s.threads);
  if (s.part != "options") run_sweeps(s);
  if (s.part != "sweeps") run_options(s);
}

}  // namespace

void add_scaling(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  CLI::App* command = app.add_subcommand(
      "scaling", "Time and memory against triangles, pixels, rays and threads, and what each option costs");
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 100));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_option("--part", s->part, "all, sweeps or options")
      ->check(CLI::IsMember({"all", "sweeps", "options"}));
  command->add_option("--most-triangles", s->most_triangles)->check(CLI::Range(1e4, 1e8));
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->add_option("--options-output", s->options_output, "those of the options, here");
  command->add_flag("--cpu-time", s->cpu_time,
                    "count CPU time instead of the wall clock's: for a busy machine");
  command->callback([s] { run(*s); });
}

}  // namespace nook::bench
