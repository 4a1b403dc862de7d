#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bvh/bvh.hpp"
#include "device/device.hpp"
#include "device/kernel_source.hpp"
#include "device/program_cache.hpp"
#include "film/film.hpp"
#include "kernels/shared/surface_point.h"
#include "kernels/shared/task.h"
#include "kernels/shared/task_result.h"
#include "plan/cut_outs.hpp"
#include "plan/kernel_arguments.hpp"
#include "plan/kernel_plan.hpp"
#include "plan/plan.hpp"
#include "plan/surface_sets.hpp"
#include "trace/sample_range.hpp"

namespace nook {

/// What a render has done so far; the run record's proof of what was simulated.
struct RenderCounters {
  std::uint64_t camera_rays = 0;
  std::uint64_t occlusion_rays = 0;
  std::uint64_t rejected = 0;  ///< estimates that were not finite: kept out of the film
  std::uint64_t launches = 0;
  std::vector<std::uint64_t> effect_rays;  ///< occlusion_rays by effect, in the plan's order
  double device_seconds = 0;               ///< in kernels, by the device's own clock
};

/// What is in the films from now on: samples `range` of the pixels [begin, end) of the list that accumulate()
/// was given.
struct Finished {
  std::size_t begin = 0, end = 0;
  SampleRange range;
};

/// How rays go through the tree (kernels/trace/traverse.cl): automatic is stream on CPUs, scalar elsewhere;
/// portable is stream without a processor's own instructions. The same bits.
enum class Traversal { automatic, stream, portable, scalar };

/// One scene on one device: uploaded once, its kernels specialised to the plan.
class OcclusionTracer {
 public:
  /// Where the text of kernels/FILE comes from: kernel_source(), or a test's version of it with a defect
  /// planted.
  using KernelSource = std::function<std::string(const std::string& file)>;

  /// The programs of a plan, by file and options.
  using Programs = std::map<std::string, BuiltProgram>;
  /// Builds them, from the disk cache or by compiling, with nothing but the plan and the width of the trees
  /// to come: while those are built, in another thread. Throws Error(device).
  static Programs build_programs(const Device& device, const Plan& plan, unsigned width,
                                 const KernelSource& source = kernel_source,
                                 Traversal traversal = Traversal::automatic);

  /// `programs` are those of the plan and of bvh's width if they are built already. `mesh` and `bvh` must
  /// outlive it: where device and host share memory they are used in place. Throws Error(device).
  OcclusionTracer(const Device& device, const Plan& plan, const TriangleMesh& mesh, const Bvh& bvh,
                  const KernelSource& source = kernel_source, Traversal traversal = Traversal::automatic,
                  Programs programs = {});

  /// Goes on with other samples of the same picture: spp camera samples a pixel in the whole render (at least
  /// 2 unless it was planned with 1), from another seed.
  void set_samples(std::uint32_t spp, std::uint32_t seed) {
    plan_.spp = spp;
    plan_.seed = seed;
  }

  /// From now on adds each pixel's camera samples at whose points nothing was in reach (EffectPlan::reach) to
  /// plane `plane` of Film::kept.
  void count_free(std::size_t plane) { free_plane_ = plane; }

  /// Rays of a launch, at most: the fewer, the more often progress is called. A launch far smaller than
  /// most_rays_per_launch costs a device more than its rays. Counts from the next launch on.
  void limit_launches(std::uint64_t rays) { rays_per_launch_ = rays; }
  static constexpr std::uint64_t most_rays_per_launch = 1u << 22;

  /// Occlusion rays a camera ray from the next launch on, instead of the plan's. It has no
  /// replicate_directions.
  void set_directions(std::uint32_t directions) { plan_.directions = directions; }

  /// Empty films of the plan's window, one per effect.
  std::vector<Film> make_films() const;

  /// Called after each launch with what it finished; false stops.
  using Progress = std::function<bool(std::span<const Finished>)>;

  /// Adds the samples of `range` of each pixel to `films` (one per effect). `pixels` are y * width + x in the
  /// whole image and must lie in the plan's window. Returns false if `progress` stopped it: what it was told
  /// of is in the films, and nothing else.
  bool accumulate(std::span<const std::uint32_t> pixels, SampleRange range, std::span<Film> films,
                  const Progress& progress = nullptr);

  /// The surface under each pixel's centre.
  std::vector<SurfacePoint> surface_points(std::span<const std::uint32_t> pixels);

  /// Estimates effect `effect` at given points, `directions` directions each; the row of a point is its
  /// random numbers' key. Film of points.size() x 1 "pixels".
  Film estimate_points(std::span<const SurfacePoint> points, std::size_t effect, std::uint32_t directions,
                       const Progress& progress = nullptr);
  /// The same for every effect of the plan.
  std::vector<Film> estimate_all(std::span<const SurfacePoint> points, std::uint32_t directions,
                                 const Progress& progress = nullptr);
  /// `count` randomisations of each point, `directions` directions each, with the seeds that
  /// Randomisations::seed_of() has for this one: films of points.size() x count "pixels". Point i has the
  /// random numbers of row first_row + i. Needs a plan with one camera sample a pixel.
  std::vector<Film> estimate_randomised(std::span<const SurfacePoint> points, std::uint32_t first_row,
                                        std::uint32_t count, std::uint32_t directions,
                                        const Progress& progress = nullptr);

  const RenderCounters& counters() const { return counters_; }
  double build_seconds() const { return build_seconds_; }
  bool all_from_cache() const { return all_from_cache_; }
  /// Keeps the programs that were compiled in the disk cache; called when the work is done, for devices other
  /// than PoCL's CPU may take time for it.
  void store_programs() {
    const auto groups = device_.info().is_cpu() ? BuiltProgram::Groups::of_one : BuiltProgram::Groups::any;
    for (auto& [key, program] : programs_) program.store(groups);
  }
  std::size_t programs() const { return programs_.size(); }

 private:
  struct Launch;
  struct Slot;
  // Fills the next launch; false when there is none.
  using NextLaunch = std::function<bool(Launch&)>;

  // A tree as kernels take it; with cut-outs what they look up follows.
  struct Tree {
    ClBuffer nodes, leaves, instances;
  };

  ClKernel kernel(const KernelPlan& kernel) const;
  std::vector<Film> estimate_list(std::span<const SurfacePoint> points, std::uint32_t first_row,
                                  std::uint32_t randomisations, std::uint32_t directions,
                                  const Progress& progress);

  // What no kernel reads is not uploaded; an argument needs a buffer all the same.
  template <class T>
  ClBuffer optional(bool wanted, const std::vector<T>& data) const;
  Tree upload(const Bvh& bvh) const;
  void upload_sets(const TriangleMesh& mesh);
  TreeArguments arguments_of(const Tree& tree) const;
  EstimatorParams params_for(const EffectPlan& effect, const Launch& launch) const;
  void enqueue(const KernelCall& call, std::size_t count, ClEvent* event = nullptr);
  cl_uint tasks_sharing_a_stream(std::uint64_t rays_of_task) const;
  void launch_primary(const EstimatorParams& params, const ClBuffer& tasks, cl_uint count, cl_mem points,
                      ClEvent* event = nullptr);
  void submit(Slot& slot);
  void harvest(Slot& slot, std::span<Film> films);
  bool run(const NextLaunch& next, std::span<Film> films, const Progress& progress);

  const Device& device_;
  Plan plan_;
  Traversal traversal_;
  unsigned width_;              // of all trees
  std::vector<Bvh> set_trees_;  // of Plan::occluder_sets
  GroupTrees group_trees_;
  CutOuts cut_outs_;
  std::vector<Tree> trees_;  // the scene's, then those of sets
  Tree trees_of_groups_;
  ClBuffer positions_, triangles_, normals_, triangle_normals_, triangle_materials_, exponents_,
      triangle_groups_, first_of_group_, point_set_, cut_triangles_, opacity_maps_, opacity_;
  std::vector<ClBuffer> receivers_;  // by effect
  Programs programs_;                // effects with the same options share one
  ClKernel primary_;
  std::vector<ClKernel> effects_;
  RenderCounters counters_;
  double build_seconds_ = 0;
  std::uint64_t rays_per_launch_ = most_rays_per_launch;
  bool all_from_cache_ = true;
  std::optional<std::size_t> free_plane_;
};

/// The window's pixels (y * width + x) in Morton order within 32x32 tiles: neighbours in the list are
/// neighbours on the image, which keeps the tree's nodes in the caches.
std::vector<std::uint32_t> pixels_in_order(const PixelRect& window, int width);

}  // namespace nook
