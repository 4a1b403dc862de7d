#include "end_to_end.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "bench/support/child.hpp"
#include "bench/support/record.hpp"
#include "bench/support/scene_files.hpp"
#include "image/exr.hpp"
#include "image/metrics.hpp"

namespace nook::bench {
namespace {

struct Settings {
  std::string scene = "bunny", output;
  PictureSettings picture;
  unsigned rounds = 5, threads = 2;
  bool cold = false, robust = false, cpu_time = false;
};

nlohmann::json read_json(const std::string& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

const std::vector<float>& red(const Image& image) {
  return std::get<std::vector<float>>(image.find("R")->values);
}

Metrics compare(const std::string& ours, const std::string& embree) {
  const Image a = read_exr(ours), b = read_exr(embree);
  return compare_images(red(a), red(b), a.width, a.height);
}

/// nook's, where PoCL's folder of each run is too.
std::map<std::string, std::string> caches_in(const TemporaryFolder& folder) {
  return {{"NOOK_CACHE_DIR", folder / "nook"}, {"POCL_CACHE_DIR", ""}};
}

void run(const Settings& s) {
  const TemporaryFolder files;
  std::size_t triangles = 0;
  {
    const BenchScene scene = bench_scene(s.scene);
    triangles = scene.mesh.triangles.size();
    write_obj(files / "mesh.obj", scene.mesh);
    write_scene(files / "scene.toml", "mesh.obj", scene, s.picture);
  }
  const std::string threads = std::to_string(s.threads);
  const std::vector<std::string> ours = {program_beside("nook"),
                                         "render",
                                         files / "scene.toml",
                                         "-o",
                                         files / "ours.exr",
                                         "--stats",
                                         files / "stats.json",
                                         "--threads",
                                         threads,
                                         "--no-png",
                                         "--quiet"};
  std::vector<std::string> embree = {program_beside("nook_bench_embree_render"),
                                     files / "scene.toml",
                                     "-o",
                                     files / "embree.exr",
                                     "--threads",
                                     threads};
  if (s.robust) embree.push_back("--robust");
  const TemporaryFolder warm;
  if (!s.cold) run_child(ours, caches_in(warm));
  std::vector<double> our_seconds, embree_seconds, ratios;
  double our_memory = 0, embree_memory = 0;
  nlohmann::json stages;
  const auto chosen = [&](const ChildTimes& t) { return s.cpu_time ? t.cpu_seconds : t.wall_seconds; };
  for (unsigned i = 0; i < s.rounds; ++i) {
    const TemporaryFolder empty;
    const ChildTimes a = run_child(ours, caches_in(s.cold ? empty : warm));
    const ChildTimes b = run_child(embree);
    our_seconds.push_back(chosen(a));
    embree_seconds.push_back(chosen(b));
    ratios.push_back(embree_seconds.back() / our_seconds.back());
    our_memory = std::max(our_memory, a.peak_bytes);
    embree_memory = std::max(embree_memory, b.peak_bytes);
    const nlohmann::json stats = read_json(files / "stats.json");
    if (stats["kernels_from_cache"] == s.cold)
      throw Error(ErrorKind::internal, "the kernel cache is not in the state that was to be measured");
    if (our_seconds.back() == *std::min_element(our_seconds.begin(), our_seconds.end()))
      stages = stats["seconds"];
  }
  const Metrics metrics = compare(files / "ours.exr", files / "embree.exr");
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  std::printf(
      "%s, %zu triangles, %ux%u, %u spp x %u directions, %s cache, %u threads: %.3f s, Embree program %.3f "
      "s: %.2fx [%.2f, %.2f]; RMSE %.5f, mean difference %.6f; %.0f and %.0f MB\n",
      s.scene.c_str(), triangles, s.picture.resolution, s.picture.resolution, s.picture.spp,
      s.picture.directions, s.cold ? "cold" : "warm", s.threads, median(our_seconds), median(embree_seconds),
      median(ratios), *least, *most, metrics.rmse, metrics.mean_difference, our_memory * 1e-6,
      embree_memory * 1e-6);
  std::printf("fastest run's stages: %s\n", stages.dump().c_str());
  append_record(s.output, {{"bench", "end-to-end"},
                           {"scene", s.scene},
                           {"triangles", triangles},
                           {"resolution", s.picture.resolution},
                           {"spp", s.picture.spp},
                           {"directions", s.picture.directions},
                           {"cache", s.cold ? "cold" : "warm"},
                           {"threads", s.threads},
                           {"rounds", s.rounds},
                           {"clock", s.cpu_time ? "cpu" : "wall"},
                           {"embree_robust", s.robust},
                           {"seconds", median(our_seconds)},
                           {"embree_seconds", median(embree_seconds)},
                           {"ratio", median(ratios)},
                           {"ratios", ratios},
                           {"stages", stages},
                           {"rmse", metrics.rmse},
                           {"mean_difference", metrics.mean_difference},
                           {"peak_bytes", our_memory},
                           {"embree_peak_bytes", embree_memory}});
}

void run_overhead(const Settings& s) {
  const TemporaryFolder files, caches;
  const BenchScene scene = bench_scene("cornell");
  write_obj(files / "mesh.obj", scene.mesh);
  write_scene(files / "scene.toml", "mesh.obj", scene, {64, 1, 16});
  const std::vector<std::string> command = {program_beside("nook"),
                                            "render",
                                            files / "scene.toml",
                                            "-o",
                                            files / "picture.exr",
                                            "--stats",
                                            files / "stats.json",
                                            "--threads",
                                            std::to_string(s.threads),
                                            "--no-png",
                                            "--quiet"};
  run_child(command, caches_in(caches));
  std::vector<double> before, whole, cpu;
  for (unsigned i = 0; i < s.rounds; ++i) {
    const ChildTimes child = run_child(command, caches_in(caches));
    const nlohmann::json seconds = read_json(files / "stats.json")["seconds"];
    const double first_ray = seconds["before_first_ray"], total = seconds["total"];
    // What the process does not see of itself, its linking and its end, counts as before the first ray.
    before.push_back(child.wall_seconds - (total - first_ray));
    whole.push_back(child.wall_seconds);
    cpu.push_back(child.cpu_seconds);
  }
  std::printf(
      "%zu triangles, warm cache, %u threads: %.1f ms before the first ray (least %.1f), %.1f ms in all, "
      "%.1f ms of CPU time\n",
      scene.mesh.triangles.size(), s.threads, 1e3 * median(before),
      1e3 * *std::min_element(before.begin(), before.end()), 1e3 * median(whole), 1e3 * median(cpu));
  append_record(s.output, {{"bench", "overhead"},
                           {"triangles", scene.mesh.triangles.size()},
                           {"threads", s.threads},
                           {"rounds", s.rounds},
                           {"clock", "wall"},
                           {"seconds_before_first_ray", median(before)},
                           {"seconds_before_first_ray_each", before},
                           {"seconds", median(whole)},
                           {"cpu_seconds", median(cpu)}});
}

}  // namespace

void add_end_to_end(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  CLI::App* command = app.add_subcommand(
      "end-to-end", "Whole processes, from OBJ to EXR: nook against our Embree program, interleaved");
  command->add_option("--scene", s->scene, "bunny, room, cornell, spaceship, or an OBJ file");
  command->add_option("--resolution", s->picture.resolution, "pixels a side")->check(CLI::Range(16, 8192));
  command->add_option("--spp", s->picture.spp)->check(CLI::Range(1, 65536));
  command->add_option("--directions", s->picture.directions)->check(CLI::Range(1, 65536));
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 100));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_flag("--cold", s->cold, "with empty kernel caches, nook's and PoCL's");
  command->add_flag("--robust", s->robust, "Embree's watertight test instead of its fast one");
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->add_flag("--cpu-time", s->cpu_time,
                    "count the processes' CPU time instead of the wall clock's: for a busy machine");
  command->callback([s] { run(*s); });
}

void add_overhead(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  s->rounds = 20;
  CLI::App* command = app.add_subcommand(
      "overhead", "What nook takes before its first ray: 36 triangles, warm cache, whole processes");
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 1000));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->callback([s] { run_overhead(*s); });
}

}  // namespace nook::bench
