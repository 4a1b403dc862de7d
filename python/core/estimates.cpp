#include "estimates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "film/bent_cone.hpp"
#include "render/picture_run.hpp"
#include "render/point_estimates.hpp"
#include "render/point_scene.hpp"
#include "render/run_checks.hpp"
#include "scene/layer_names.hpp"
#include "scene/settings.hpp"

namespace nook::python {
namespace {

void warn_of_rejected(std::uint64_t before, const OcclusionTracer& tracer, RunObserver& observer) {
  if (const std::uint64_t rejected = tracer.counters().rejected - before)
    observer.warn(fmt::format("{} samples were not finite and left out", rejected));
}

Estimates estimates_of(const Film& film, double weight_bound) {
  Estimates made;
  const std::size_t count = film.pixels();
  made.value.resize(count);
  made.standard_error.resize(count);
  made.samples.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    made.value[i] = float(film.value(i));
    made.standard_error[i] = float(standard_error(film, i, weight_bound));
    made.samples[i] = film.replicates[i] * film.per_replicate;
  }
  if (film.extra.empty()) return made;
  made.half_angle.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const BentCone cone = bent_cone(film, i);
    for (int axis = 0; axis < 3; ++axis) made.direction.push_back(cone.direction[axis]);
    made.half_angle[i] = cone.half_angle;
  }
  return made;
}

}  // namespace

std::vector<Layer> layers_of(const Plan& plan) {
  std::vector<Layer> layers;
  for (const LayerPlan& layer : plan.layers) {
    const std::string& p = layer.prefix;
    std::vector<std::string> channels = {p + "R"};
    if (layer.kind == EffectKind::bent) channels = {p + "X", p + "Y", p + "Z"};
    if (layer.kind == EffectKind::depth) channels = {p + "Z"};
    if (layer.kind == EffectKind::normal || layer.kind == EffectKind::position)
      channels = p.empty() ? std::vector<std::string>{"R", "G", "B"}
                           : std::vector<std::string>{p + "X", p + "Y", p + "Z"};
    layers.push_back({effect_label(layer.kind, p), std::move(channels)});
  }
  return layers;
}

Estimates estimate(Workspace& workspace, const PointRequest& request, RunObserver& observer) {
  const std::lock_guard lock(workspace.mutex);
  Scene scene = workspace.scene();
  choose_effect_at_points(request.kind, scene);
  apply_settings(request.settings, false, scene);
  if (scene.stop.any() && scene.stop.error != workspace.scene().stop.error)
    throw Error(ErrorKind::usage, "error, time: points have a number of samples");
  scene = scene_at_points(std::move(scene), request.samples);
  Workspace::Use use{needed_attributes(scene)};
  use.attributes.normals = false;
  use.point_set = request.point_set;
  use.shift_points = request.shift_points;
  SceneRenderer& renderer = workspace.renderer(scene, use);
  if (request.kind == EffectKind::ro && request.views.empty())
    throw Error(ErrorKind::usage, "views: RO needs the directions to the viewer");
  const std::vector<SurfacePoint> points =
      points_of_arrays(request.points, request.normals, request.views, renderer.mesh());
  renderer.expect_rays(double(points.size()) * request.samples);
  const std::uint64_t before = renderer.tracer().counters().rejected;
  const Film film = std::move(renderer.estimate(points, request.samples, &observer).front());
  warn_of_rejected(before, renderer.tracer(), observer);
  renderer.tracer().store_programs();
  Estimates made = estimates_of(film, renderer.plan().effects[0].weight_bound);
  // One set of points has no spread that would tell an error.
  if (request.samples == request.point_set.size())
    std::fill_n(made.standard_error.begin(), points.size(), NAN);
  return made;
}

Picture render(Workspace& workspace, const std::string& settings, const std::vector<std::string>& aovs,
               RunObserver& observer) {
  const std::lock_guard lock(workspace.mutex);
  const Scene scene = workspace.with(settings);
  if (const auto conflict = conflict_of_run(scene))
    throw Error(ErrorKind::usage, fmt::format("{}: {}", conflict->key, conflict->what));
  if (scene.stop.any()) check_samples(scene, scene.stop.max_spp);
  check_memory(scene, aovs.size(), scene.stop.error ? largest_rule_bytes : 0);
  const AovRequest asked = parse_aovs(aovs);
  const bool surface = asked.needs_surface(), alone = is_ssao_alone(scene);
  const Workspace::Use use{needed_attributes(scene, alone ? asked.normal : surface), surface};
  SceneRenderer& renderer = workspace.renderer(scene, use);
  PictureRequest request;
  request.aovs = aovs;
  PictureRun run(renderer, std::move(request));
  const std::uint64_t before = renderer.plan().effects.empty() ? 0 : renderer.tracer().counters().rejected;
  run.take(observer);
  Picture made{run.image(), scene.background, layers_of(renderer.plan()), run.complete()};
  if (!renderer.plan().effects.empty()) warn_of_rejected(before, renderer.tracer(), observer);
  if (renderer.plan().needs_opencl()) renderer.tracer().store_programs();
  return made;
}

}  // namespace nook::python
