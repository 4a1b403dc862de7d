#include "occlusion.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/driver_threads.hpp"
#include "base/error.hpp"
#include "bench/embree/embree_occlusion.hpp"
#include "bench/support/kernel_runner.hpp"
#include "bench/support/record.hpp"
#include "bench/support/stopwatch.hpp"
#include "plan/tree_options.hpp"

namespace nook::bench {
namespace {

struct Settings {
  std::string scene = "bunny";
  std::string rays = "ao";
  unsigned rounds = 7, threads = 2, resolution = 1024, directions = 16, width = 0;
  float exponent = 30, max_distance = std::numeric_limits<float>::infinity();
  std::vector<std::string> defines;
  std::string device, output, against;
  bool ours_only = false, unrefined = false, cpu_time = false;
};

BuildOptions build_options(const std::vector<std::string>& defines) {
  BuildOptions options;
  for (const std::string& d : defines) {
    const auto equals = d.find('=');
    options.define(d.substr(0, equals), equals == std::string::npos ? 1 : std::stol(d.substr(equals + 1)));
  }
  return options;
}

/// One kind of rays as both sides trace it.
struct Workload {
  std::function<double(KernelRunner&)> ours;
  std::function<double(const EmbreeVariant&, const EmbreeScene&)> embree;
  std::function<std::uint64_t()> mismatches;  ///< between the last runs of the two
  std::uint64_t rays = 0;
};

std::uint64_t differing_bits(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += std::uint64_t(std::popcount(a[i] ^ b[i]));
  return n;
}

std::uint64_t differing_distances(const std::vector<float>& a, const std::vector<float>& b) {
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    n += !(a[i] == b[i] || std::abs(a[i] - b[i]) <= 1e-4f * std::abs(b[i]));
  return n;
}

void run(const Settings& s) {
  if (s.cpu_time) measured = Stopwatch::Of::threads;
  limit_driver_threads(s.threads);
  const BenchScene scene = bench_scene(s.scene);
  const EmbreeScene fast(scene.mesh, false, s.threads), robust(scene.mesh, true, s.threads);
  const Device device(select_device(s.device));
  const Bvh bvh = build_bvh(scene.mesh, {.threads = s.threads,
                                         .width = s.width ? s.width : tree_width(device.info(), {}),
                                         .refined = !s.unrefined});
  std::printf("%s: %zu triangles; %u children a node, %.1f B and %.2f SAH, %.1f triangles a leaf\n",
              s.scene.c_str(), scene.mesh.triangles.size(), bvh.width(),
              double(bvh.bytes()) / double(scene.mesh.triangles.size()), bvh.statistics.sah_cost,
              bvh.statistics.triangles_per_leaf);

  KernelRunner runner(device, bvh, build_options(s.defines));
  const unsigned samples = s.rays == "own" || s.rays == "primary" ? 16 : 1;
  const unsigned resolution = samples > 1 ? s.resolution / 2 : s.resolution;
  const std::vector<vec3> camera = camera_directions(scene, resolution, samples);
  const DirectionSets sets = direction_sets(s.directions, s.rays == "ro" ? s.exponent : 1.0f);
  std::vector<RayPoint> points;
  if (s.rays != "primary") points = visible_points(scene, robust, camera, s.rays == "ro");

  std::vector<std::uint32_t> our_bits, embree_bits;
  std::vector<float> our_distances, embree_distances;
  Workload work;
  if (s.rays == "primary") {
    runner.set_camera_rays(camera);
    work.ours = [&](KernelRunner& r) { return r.closest(scene.eye, 32, our_distances); };
    work.embree = [&](const EmbreeVariant& v, const EmbreeScene& e) {
      return v.closest(e, scene.eye, camera, s.threads, embree_distances);
    };
    work.mismatches = [&] { return differing_distances(our_distances, embree_distances); };
    work.rays = camera.size();
  } else {
    runner.set_points(points, sets);
    const bool own = s.rays == "own";
    work.ours = [&, own](KernelRunner& r) {
      return own ? r.own(s.max_distance, our_bits) : r.shared(s.max_distance, our_bits);
    };
    work.embree = [&, own](const EmbreeVariant& v, const EmbreeScene& e) {
      return (own ? v.own : v.shared)(e, points, sets, s.max_distance, s.threads, embree_bits);
    };
    work.mismatches = [&] { return differing_bits(our_bits, embree_bits); };
    work.rays = points.size() * (own ? 1 : s.directions);
  }

  work.ours(runner);  // compiles and touches memory
  std::vector<double> ours, embree, ratios;
  if (s.ours_only) {
    for (unsigned i = 0; i < s.rounds; ++i) ours.push_back(work.ours(runner));
    std::printf("%s %s: %.2f Mrays/s (best %.2f)\n", s.scene.c_str(), s.rays.c_str(),
                double(work.rays) / median(ours) * 1e-6,
                double(work.rays) / *std::min_element(ours.begin(), ours.end()) * 1e-6);
    return;
  }

  // Embree's best variant on these rays: one run of each.
  std::string best;
  double best_seconds = std::numeric_limits<double>::infinity();
  const std::vector<EmbreeVariant> variants = embree_variants();
  const EmbreeVariant* best_variant = nullptr;
  const EmbreeScene* best_scene = nullptr;
  nlohmann::json tried;
  for (const EmbreeScene* e : {&fast, &robust})
    for (const EmbreeVariant& v : variants) {
      const std::string name = v.name + (e == &robust ? " robust" : " fast");
      if (!s.against.empty() && name != s.against) continue;
      const double seconds = work.embree(v, *e);
      tried[name] = double(work.rays) / seconds * 1e-6;
      if (seconds < best_seconds) best_seconds = seconds, best = name, best_variant = &v, best_scene = e;
    }
  if (!best_variant) throw Error(ErrorKind::usage, "--against '" + s.against + "': no such variant");
  for (unsigned i = 0; i < s.rounds; ++i) {
    ours.push_back(work.ours(runner));
    embree.push_back(work.embree(*best_variant, *best_scene));
    ratios.push_back(embree.back() / ours.back());
  }
  const std::uint64_t against_best = work.mismatches();
  work.embree(variants[0], robust);
  const std::uint64_t against_robust = work.mismatches();
  const double our_rate = double(work.rays) / median(ours) * 1e-6,
               embree_rate = double(work.rays) / median(embree) * 1e-6;
  std::printf(
      "%s %s, %u threads: %.2f Mrays/s, Embree %.2f (%s): %.2fx [%.2f, %.2f]; %llu of %llu rays differ (%llu "
      "from robust)\n",
      s.scene.c_str(), s.rays.c_str(), s.threads, our_rate, embree_rate, best.c_str(), median(ratios),
      *std::min_element(ratios.begin(), ratios.end()), *std::max_element(ratios.begin(), ratios.end()),
      (unsigned long long)against_best, (unsigned long long)work.rays, (unsigned long long)against_robust);
  nlohmann::json record{{"bench", "occlusion"},
                        {"scene", s.scene},
                        {"rays", s.rays},
                        {"threads", s.threads},
                        {"rounds", s.rounds},
                        {"triangles", scene.mesh.triangles.size()},
                        {"ray_count", work.rays},
                        {"directions", s.directions},
                        {"width", bvh.width()},
                        {"refined", !s.unrefined},
                        {"clock", s.cpu_time ? "cpu" : "wall"},
                        {"mrays_per_s", our_rate},
                        {"embree_mrays_per_s", embree_rate},
                        {"embree_variant", best},
                        {"embree_tried", tried},
                        {"ratio", median(ratios)},
                        {"ratios", ratios},
                        {"mismatches", against_best},
                        {"mismatches_robust", against_robust},
                        {"defines", s.defines},
                        {"device", device.info().name},
                        {"bytes_per_triangle", double(bvh.bytes()) / double(scene.mesh.triangles.size())}};
  if (s.rays == "ro") record["exponent"] = s.exponent;
  if (s.max_distance < std::numeric_limits<float>::infinity()) record["max_distance"] = s.max_distance;
  append_record(s.output, record);
}

}  // namespace

void add_occlusion(CLI::App& app) {
  auto s = std::make_shared<Settings>();
  CLI::App* command =
      app.add_subcommand("occlusion", "Rays a second, ours against Embree's best variant, interleaved");
  command->add_option("--scene", s->scene, "bunny, room, cornell, spaceship, or an OBJ file");
  command
      ->add_option("--rays", s->rays,
                   "ao: directions from a point; ro: lobes; own: one direction from each of 16 points a "
                   "pixel; primary")
      ->check(CLI::IsMember({"ao", "ro", "own", "primary"}));
  command->add_option("--rounds", s->rounds)->check(CLI::Range(1, 100));
  command->add_option("--threads", s->threads)->check(CLI::Range(1, 1024));
  command->add_option("--resolution", s->resolution, "pixels a side; own and primary use half")
      ->check(CLI::Range(16, 8192));
  command->add_option("--directions", s->directions)->check(CLI::Range(1, 32));
  command->add_option("--width", s->width, "children a node; what the device asks for unless given")
      ->check(CLI::IsMember({8, 16}));
  command->add_flag("--unrefined", s->unrefined, "the tree of a render of few rays");
  command->add_option("--exponent", s->exponent, "of the lobe");
  command->add_option("--max-distance", s->max_distance, "world units");
  command->add_option("--against", s->against,
                      "one Embree variant, as '1M incoherent fast', instead of the best of all");
  command->add_option("-D", s->defines, "kernel macro, NAME=VALUE; repeatable");
  command->add_option("--device", s->device);
  command->add_option("--output", s->output, "JSON lines are appended here");
  command->add_flag("--cpu-time", s->cpu_time,
                    "measure the process's CPU time instead of the wall clock's: for a busy machine");
  command->add_flag("--ours-only", s->ours_only, "time our side alone");
  command->callback([s] { run(*s); });
}

}  // namespace nook::bench
