#include "render/point_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "points/outside.hpp"
#include "points/points.hpp"
#include "scene/effect_keys.hpp"

namespace nook {

void choose_effect_at_points(std::optional<EffectKind> asked, Scene& scene) {
  const EffectKind kind = asked.value_or(scene.effects.front().kind);
  if (!is_traced(kind)) throw Error(ErrorKind::usage, "points need an effect of type ao, ro or bent");
  const auto found = std::find_if(scene.effects.begin(), scene.effects.end(),
                                  [kind](const Effect& e) { return e.kind == kind; });
  Effect effect = found == scene.effects.end() ? scene.effects.front() : *found;
  if (effect.kind != kind) {
    const Effect standard = default_effect(kind);
    effect.kind = kind;
    effect.sampling = standard.sampling;
    effect.max_distance = standard.max_distance;
  }
  scene.effects = {effect};
}

Scene scene_at_points(Scene scene, std::uint32_t directions) {
  const Effect& effect = scene.effects.front();
  if (effect.kind == EffectKind::ro && effect.exponent_of_material)
    throw Error(ErrorKind::usage, "exponent: points have no material, give the number to use");
  if (effect.only_self)
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                "occluders = \"self\": a probe's points belong to no group");
  scene.denoise = false;
  scene.stop = {};
  scene.spp = 1;
  scene.directions = directions;
  scene.direction_choice = Scene::DirectionChoice::given;
  scene.crop.reset();
  return scene;
}

std::vector<SurfacePoint> points_of_arrays(std::span<const double> positions, std::span<const double> normals,
                                           std::span<const double> views, const TriangleMesh& mesh) {
  const std::size_t count = positions.size() / 3;
  const auto row = [](std::span<const double> values, std::size_t i) {
    return dvec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  const auto check = [&](std::span<const double> values, const char* name) {
    if (values.size() != positions.size())
      throw Error(ErrorKind::usage,
                  fmt::format("{}: {} rows, and {} points", name, values.size() / 3, count));
    for (std::size_t i = 0; i < count; ++i)
      if (row(values, i) == dvec3(0))
        throw Error(ErrorKind::usage, fmt::format("{}: row {} is zero", name, i));
  };
  check(normals, "normals");
  if (!views.empty()) check(views, "views");
  std::vector<SurfacePoint> points(count);
  for (std::size_t i = 0; i < count; ++i)
    points[i] = surface_point(vec3(mesh.frame.from_file(row(positions, i))), unit(row(normals, i)),
                              views.empty() ? vec3(0) : unit(row(views, i)));
  move_outside(points, mesh);
  return points;
}

}  // namespace nook
