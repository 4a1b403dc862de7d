// nook_bench instances: oaks of scenes/generated on a square, as trees in place and as copies. Measures
// memory, loading, trees and rendering of whole processes, in rounds that take turns, and checks that the
// pictures are the same.
#include "instances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "bench/support/child.hpp"
#include "bench/support/record.hpp"
#include "image/exr.hpp"

namespace nook::bench {
namespace {

struct Settings {
  std::vector<unsigned> counts = {1, 10, 60, 400, 1000};
  unsigned spp = 16, rounds = 3, threads = 2;
  bool only_trees = false;
  std::string output;
};

constexpr const char* mesh_file = NOOK_SOURCE_DIR "/scenes/generated/oak.obj";

// `count` oaks on a square grid, turned by the golden angle, seen from above its edge.
void write_forest(const std::string& path, unsigned count, unsigned spp, const std::string& instancing) {
  const auto side = unsigned(std::ceil(std::sqrt(count)));
  std::ofstream out(path);
  out << "[input]\ninstancing = \"" << instancing << "\"\n";
  for (unsigned i = 0; i < count; ++i) {
    const double x = 1.7 * (i % side) - 0.85 * (side - 1), z = 1.7 * (i / side) - 0.85 * (side - 1);
    out << "[[instance]]\nobjfile = \"" << mesh_file << "\"\ntranslate = [" << x << ", 0.0, " << z
        << "]\nrotate = [0.0, " << 137.5 * i << ", 0.0]\n";
  }
  const double reach = 0.85 * side + 3;
  out << "[ground]\n[camera]\neye = [0.0, " << 1 + 0.6 * reach << ", " << 1.6 * reach
      << "]\nat = [0.0, 0.6, 0.0]\n"
      << "up = [0.0, 1.0, 0.0]\nfov = 40.0\n[film]\nwidth = 512\nheight = 384\n[renderer]\ntype = "
         "\"ao\"\nspp = "
      << spp << "\nmax_distance = 3.0\nside = \"viewer\"\n";
  if (!out.flush()) throw Error(ErrorKind::output, "cannot write " + path);
}

struct Side {
  std::vector<double> cpu_seconds, render, tree, load;
  double peak_bytes = 0;
};

void add_run(const Settings& s, const TemporaryFolder& files, const std::string& instancing, Side& side) {
  const ChildTimes times = run_child({program_beside("nook"), "render", files / (instancing + ".toml"), "-o",
                                      files / (instancing + ".exr"), "--stats", files / "stats.json",
                                      "--threads", std::to_string(s.threads), "--no-png", "--quiet"});
  std::ifstream in(files / "stats.json");
  const auto stats = nlohmann::json::parse(in);
  side.cpu_seconds.push_back(times.cpu_seconds);
  side.peak_bytes = std::max(side.peak_bytes, times.peak_bytes);
  side.load.push_back(stats["seconds"]["load"]);
  side.tree.push_back(stats["seconds"]["bvh"]);
  side.render.push_back(stats["seconds_on_device"]);
}

const std::vector<float>& red(const Image& image) {
  return std::get<std::vector<float>>(image.find("R")->values);
}

void report(const Settings& s, unsigned count, const std::string& name, const Side& side) {
  std::printf("| %u | %s | %.0f | %.2f | %.2f | %.2f | %.2f |\n", count, name.c_str(), side.peak_bytes * 1e-6,
              median(side.load), median(side.tree), median(side.render), median(side.cpu_seconds));
  std::fflush(stdout);
  append_record(s.output, {{"bench", "instances"},
                           {"instances", count},
                           {"kept_as", name},
                           {"spp", s.spp},
                           {"threads", s.threads},
                           {"rounds", s.rounds},
                           {"peak_bytes", side.peak_bytes},
                           {"load_seconds", median(side.load)},
                           {"tree_seconds", median(side.tree)},
                           {"device_seconds", median(side.render)},
                           {"cpu_seconds", median(side.cpu_seconds)}});
}

void measure(const Settings& s, unsigned count) {
  const TemporaryFolder files;
  Side copies, trees;
  for (const char* instancing : {"copies", "tree"})
    write_forest(files / (std::string(instancing) + ".toml"), count, s.spp, instancing);
  for (unsigned round = 0; round < s.rounds; ++round) {
    if (!s.only_trees) add_run(s, files, "copies", copies);
    add_run(s, files, "tree", trees);
  }
  if (!s.only_trees) {
    report(s, count, "copies", copies);
    const Image a = read_exr(files / "copies.exr"), b = read_exr(files / "tree.exr");
    if (red(a) != red(b)) throw Error(ErrorKind::internal, "the pictures of copies and trees differ");
  }
  report(s, count, "trees", trees);
}

void run(const Settings& s) {
  if (!std::ifstream(mesh_file))
    throw Error(ErrorKind::scene, std::string(mesh_file) + " is missing: build the target nook_scene_oak");
  std::printf(
      "| oaks | as | MB | load | tree | kernels | CPU seconds in all |\n|---|---|---|---|---|---|---|\n");
  for (const unsigned count : s.counts) measure(s, count);
}

}  // namespace

void add_instances(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  CLI::App* command =
      app.add_subcommand("instances", "Instances as trees in place against copies, whole processes");
  command->add_option("--counts", s->counts, "how many oaks of 17 790 triangles")
      ->delimiter(',')
      ->check(CLI::Range(1, 200000));
  command->add_option("--spp", s->spp)->check(CLI::Range(2, 65536));
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 100));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_flag("--only-trees", s->only_trees,
                    "without the copies, which 10 000 oaks have no memory for");
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->callback([s] { run(*s); });
}

}  // namespace nook::bench
