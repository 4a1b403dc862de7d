#include "render/scene_renderer.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "adaptive/stop_target.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "bvh/bvh.hpp"
#include "mesh/mesh_analysis.hpp"
#include "plan/scene_mesh.hpp"
#include "plan/tree_options.hpp"
#include "render/picture_run.hpp"
#include "render/point_estimates.hpp"

namespace nook {

// The tree is of the mesh, and the tracer keeps references to all three.
struct SceneRenderer::Shared {
  TriangleMesh mesh;
  std::string mesh_hash;  // empty until it is asked for
  std::future<Device> opening;
  OpenDevice open;
  std::optional<Device> device;
  // What a plan asks of reach depends on the tree (tree_width()), so it has one that no other plan chose.
  std::optional<Bvh> trees[2];
};

SceneRenderer::SceneRenderer(Scene scene, OpenDevice open, SceneRendererOptions options)
    : scene_(std::move(scene)), options_(std::move(options)), shared_(std::make_shared<Shared>()) {
  open_device(std::move(open));
  options_.mesh_of_files = true;
  Stopwatch watch;
  shared_->mesh =
      load_scene_mesh(scene_, options_.attributes.value_or(needed_attributes(scene_, options_.surface)),
                      options_.instancing.value_or(scene_.instancing));
  seconds_.load = watch.lap();
  make_plan();
}

SceneRenderer::SceneRenderer(Scene scene, TriangleMesh mesh, OpenDevice open, SceneRendererOptions options)
    : scene_(std::move(scene)), options_(std::move(options)), shared_(std::make_shared<Shared>()) {
  open_device(std::move(open));
  shared_->mesh = std::move(mesh);
  make_plan();
}

SceneRenderer::SceneRenderer(const SceneRenderer& other, Scene scene, std::optional<bool> surface)
    : scene_(std::move(scene)), options_(other.options_), shared_(other.shared_) {
  options_.surface = surface.value_or(options_.surface);
  make_plan();
}

SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;

// Starting OpenCL takes longer than reading a small mesh.
void SceneRenderer::open_device(OpenDevice open) {
  shared_->open = std::move(open);
  if (!is_ssao_alone(scene_)) shared_->opening = std::async(std::launch::async, shared_->open);
}

void SceneRenderer::make_plan() {
  plan_ = plan_until(scene_.stop,
                     nook::make_plan(scene_, shared_->mesh, options_.surface && !is_ssao_alone(scene_)));
}

const TriangleMesh& SceneRenderer::mesh() const {
  return shared_->mesh;
}

const std::string& SceneRenderer::mesh_hash() const {
  if (shared_->mesh_hash.empty()) shared_->mesh_hash = nook::mesh_hash(shared_->mesh);
  return shared_->mesh_hash;
}

const Device& SceneRenderer::device() {
  if (!shared_->device)
    shared_->device.emplace(shared_->opening.valid() ? shared_->opening.get() : shared_->open());
  return *shared_->device;
}

const Bvh& SceneRenderer::tree() {
  std::optional<Bvh>& tree = shared_->trees[plan_.asks_reach()];
  if (!tree) {
    const BvhOptions options =
        tree_options(device().info(), plan_, rays_.value_or(planned_rays(plan_)), options_.threads);
    Stopwatch watch;
    tree = build_bvh(shared_->mesh, options);
    seconds_.bvh = watch.lap();
  }
  return *tree;
}

// Compiling takes about as long as building a tree.
OcclusionTracer& SceneRenderer::tracer() {
  if (tracer_) return *tracer_;
  const Device& on = device();
  const std::optional<Bvh>& there = shared_->trees[plan_.asks_reach()];
  const unsigned width = there ? there->width() : tree_width(on.info(), plan_);
  std::future<OcclusionTracer::Programs> programs = std::async(std::launch::async, [&] {
    return OcclusionTracer::build_programs(on, plan_, width, options_.source, options_.traversal);
  });
  const Bvh& built = tree();
  tracer_ = std::make_unique<OcclusionTracer>(on, plan_, shared_->mesh, built, options_.source,
                                              options_.traversal, programs.get());
  seconds_.compile = tracer_->build_seconds();
  if (plan_.choose_directions) {
    directions_ = choose_directions(*tracer_, plan_, scene_.stop.error);
    plan_.directions = directions_->directions;
    plan_.choose_directions = false;
  }
  return *tracer_;
}

Image SceneRenderer::render(RunObserver* observer, const std::vector<std::string>& aovs) {
  RunObserver unwatched;
  PictureRequest request;
  request.aovs = aovs;
  PictureRun run(*this, std::move(request));
  run.take(observer ? *observer : unwatched);
  return run.image();
}

std::vector<Film> SceneRenderer::estimate(std::span<const SurfacePoint> points, std::uint32_t directions,
                                          RunObserver* observer) {
  RunProgress now;
  now.total = std::max<std::uint64_t>(1, std::uint64_t(points.size()) * directions);
  bool cancelled = false;
  const std::uint64_t before = tracer().counters().occlusion_rays;
  std::vector<Film> films =
      estimate_at_points(tracer(), plan_, points, directions, [&](std::span<const Finished> finished) {
        if (!observer) return true;
        for (const Finished& f : finished) now.samples += std::uint64_t(f.end - f.begin) * f.range.count;
        now.rays = tracer().counters().occlusion_rays - before;
        observer->progress(now);
        cancelled = observer->cancelled();
        return !cancelled;
      });
  if (observer) observer->end();
  if (cancelled) throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
  return films;
}

}  // namespace nook
