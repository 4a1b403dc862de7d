#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adaptive/directions.hpp"
#include "device/device.hpp"
#include "image/image.hpp"
#include "mesh/triangle_mesh.hpp"
#include "plan/plan.hpp"
#include "render/observer.hpp"
#include "scene/scene.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {

/// How a scene is to be made ready, where the scene itself does not say.
struct SceneRendererOptions {
  unsigned threads = 0;  ///< that build trees; 0: all
  bool surface = false;  ///< normals, positions or depths are asked for beside the effects
  std::optional<MeshAttributes> attributes;  ///< read of mesh files; unset: what the effects need
  std::optional<Instancing> instancing;      ///< instead of the scene's
  OcclusionTracer::KernelSource source = kernel_source;
  Traversal traversal = Traversal::automatic;
  bool mesh_of_files = false;  ///< a mesh that is given was read from the scene's files
};

/// Wall-clock seconds that making ready took.
struct ReadySeconds {
  double load = 0, bvh = 0, compile = 0;
};

/// The front door: a scene on a device, and what its pictures and point estimates share, each made when it is
/// first asked for. The device is opened while the mesh is read, and kernels are built beside the tree.
///
///     SceneRenderer renderer(load_scene("room.toml"), [] { return Device(select_device("")); });
///     const Image picture = renderer.render();
///     const std::vector<Film> at_points = renderer.estimate(points, 1024);
///
/// A scene of screen-space effects alone opens no device and builds no tree. One thread at a time may use it;
/// two renderers may work in two threads.
class SceneRenderer {
 public:
  using OpenDevice = std::function<Device()>;

  /// Reads the scene's mesh files. Throws Error(scene).
  SceneRenderer(Scene scene, OpenDevice open, SceneRendererOptions options = {});
  /// The same with a mesh that is there: its files are not looked for.
  SceneRenderer(Scene scene, TriangleMesh mesh, OpenDevice open, SceneRendererOptions options = {});
  /// Another view or other effects of `other`'s mesh, on its device, through its tree. `other` may go.
  /// surface: instead of its SceneRendererOptions::surface.
  SceneRenderer(const SceneRenderer& other, Scene scene, std::optional<bool> surface = {});
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;

  const Scene& scene() const { return scene_; }
  const TriangleMesh& mesh() const;
  /// It is what the scene's files hold, so that its pictures can be made again.
  bool mesh_of_files() const { return options_.mesh_of_files; }
  /// nook::mesh_hash() of it.
  const std::string& mesh_hash() const;
  /// What will be computed, with the scene's stop target in it (plan_until()).
  const Plan& plan() const { return plan_; }
  /// Lets a pilot choose the plan's directions, if the scene leaves them open; tracer() does so too. Then
  /// `directions` says why. Throws Error(device).
  void settle() {
    if (plan_.choose_directions) tracer();
  }
  const std::optional<DirectionChoice>& directions() const { return directions_; }
  /// Renders by another plan of the same scene; before tree() or tracer() are asked for.
  void set_plan(Plan plan) { plan_ = std::move(plan); }
  /// How many rays the tree is built for, instead of planned_rays(); before it is asked for.
  void expect_rays(double rays) { rays_ = rays; }

  /// These throw Error(device).
  const Device& device();
  const Bvh& tree();
  OcclusionTracer& tracer();

  /// The picture: every layer, and the channels `aovs` (as --aov names them). Ends at the scene's samples,
  /// error or time (counted from here); bits depend on scene, mesh and kernels alone. Throws Error, also
  /// (interrupted) if `observer` cancels it, after which the renderer can be used again.
  Image render(RunObserver* observer = nullptr, const std::vector<std::string>& aovs = {});

  /// Every effect's estimate at given points, `directions` directions each, in the plan's order: films of
  /// points.size() x 1 "pixels". A point's random numbers depend on its index. Throws as render().
  std::vector<Film> estimate(std::span<const SurfacePoint> points, std::uint32_t directions,
                             RunObserver* observer = nullptr);

  const ReadySeconds& seconds() const { return seconds_; }

 private:
  struct Shared;
  void open_device(OpenDevice open);
  void make_plan();

  Scene scene_;
  SceneRendererOptions options_;
  std::shared_ptr<Shared> shared_;  // mesh, device, tree
  Plan plan_;
  std::optional<double> rays_;
  std::unique_ptr<OcclusionTracer> tracer_;
  std::optional<DirectionChoice> directions_;
  ReadySeconds seconds_;
};

}  // namespace nook
