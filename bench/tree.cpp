#include "tree.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/embree/embree_scene.hpp"
#include "bench/support/bench_scene.hpp"
#include "bench/support/record.hpp"
#include "bench/support/stopwatch.hpp"
#include "bvh/bvh.hpp"

namespace nook::bench {
namespace {

struct Settings {
  std::string scene = "bunny";
  unsigned rounds = 7, threads = 2;
  std::string output;
  bool cpu_time = false, refined = false;
};

void run(const Settings& s) {
  if (s.cpu_time) measured = Stopwatch::Of::threads;
  const BenchScene scene = bench_scene(s.scene);
  std::vector<double> ours, embree, ratios;
  Bvh bvh;
  for (unsigned i = 0; i < s.rounds; ++i) {
    bvh = {};
    const Stopwatch watch = started();
    bvh = build_bvh(scene.mesh, {.threads = s.threads, .refined = s.refined});  // of 16 children
    ours.push_back(watch.seconds());
    embree.push_back(EmbreeScene(scene.mesh, false, s.threads).commit_seconds());
    ratios.push_back(ours.back() / embree.back());
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  const double bytes = double(bvh.bytes()) / double(scene.mesh.triangles.size());
  std::printf(
      "%s%s tree, %u threads, %zu triangles: %.3f s (collapse %.3f s), Embree %.3f s: %.2fx its time [%.2f, "
      "%.2f]; %.1f B a triangle, SAH %.2f\n",
      s.scene.c_str(), s.refined ? ", refined" : "", s.threads, scene.mesh.triangles.size(), median(ours),
      bvh.statistics.collapse_seconds, median(embree), median(ratios), *least, *most, bytes,
      bvh.statistics.sah_cost);
  append_record(s.output, {{"bench", "tree"},
                           {"scene", s.scene},
                           {"threads", s.threads},
                           {"rounds", s.rounds},
                           {"refined", s.refined},
                           {"clock", s.cpu_time ? "cpu" : "wall"},
                           {"triangles", scene.mesh.triangles.size()},
                           {"seconds", median(ours)},
                           {"embree_seconds", median(embree)},
                           {"time_ratio", median(ratios)},
                           {"time_ratios", ratios},
                           {"bytes_per_triangle", bytes},
                           {"sah_cost", bvh.statistics.sah_cost}});
}

}  // namespace

void add_tree(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  CLI::App* command = app.add_subcommand(
      "tree", "Seconds to build the tree, against rtcCommitScene at MEDIUM quality, interleaved");
  command->add_option("--scene", s->scene, "bunny, room, cornell, spaceship, or an OBJ file");
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 100));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_flag("--refined", s->refined, "the tree of a render of many rays");
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->add_flag("--cpu-time", s->cpu_time,
                    "measure the process's CPU time instead of the wall clock's: for a busy machine");
  command->callback([s] { run(*s); });
}

}  // namespace nook::bench
