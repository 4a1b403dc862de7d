#include "render/bake.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "film/bent_cone.hpp"
#include "points/corner_points.hpp"
#include "points/vertex_points.hpp"

namespace nook {
namespace {

constexpr std::uint64_t most_directions = 1u << 26;

void add_properties(const EffectPlan& effect, const Film& film, std::vector<VertexProperty>& made) {
  const std::string name = effect.label();
  const auto add = [&](const std::string& property, auto get) {
    std::vector<float> values(film.pixels());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = get(i);
    made.push_back({property, std::move(values)});
  };
  if (effect.effect.kind != EffectKind::bent) {
    add(name, [&](std::size_t i) { return float(film.value(i)); });
    return;
  }
  static constexpr const char* axes[] = {"_x", "_y", "_z"};
  for (int axis = 0; axis < 3; ++axis)
    add(name + axes[axis], [&](std::size_t i) { return bent_cone(film, i).direction[axis]; });
  add(name + "_cone", [&](std::size_t i) { return bent_cone(film, i).half_angle; });
  add(name + "_ao", [&](std::size_t i) { return float(film.value(i)); });
}

MeshBake bake_points(SceneRenderer& renderer, std::vector<vec3> normals,
                     const std::vector<SurfacePoint>& points, RunObserver* observer) {
  MeshBake made{std::move(normals), {}};
  const std::vector<Film> films = bake_at(renderer, points, observer);
  for (std::size_t e = 0; e < films.size(); ++e)
    add_properties(renderer.plan().effects[e], films[e], made.properties);
  return made;
}

}  // namespace

Scene scene_to_bake(Scene scene) {
  std::erase_if(scene.effects,
                [](const Effect& e) { return e.kind != EffectKind::ao && e.kind != EffectKind::bent; });
  if (scene.effects.empty())
    throw Error(ErrorKind::scene, Place{scene.file.string()}, "a bake needs an effect of type ao or bent");
  for (const Effect& effect : scene.effects)
    if (effect.view_space || effect.side == Side::viewer)
      throw Error(ErrorKind::scene, Place{scene.file.string()},
                  fmt::format("a bake has no viewer: {}",
                              effect.view_space ? "space = \"view\"" : "side = \"viewer\""));
  const std::uint64_t directions = std::uint64_t(scene.spp) * scene.directions;
  if (directions > most_directions)
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                fmt::format("spp x directions is {}, at most {} for a bake", directions, most_directions));
  scene.directions = std::uint32_t(directions);
  scene.direction_choice = Scene::DirectionChoice::given;
  scene.spp = 1;
  scene.denoise = false;
  scene.crop.reset();
  return scene;
}

MeshAttributes baked_attributes(const Scene& scene, bool to_texture) {
  MeshAttributes attributes = needed_attributes(scene);
  attributes.uvs = attributes.uvs || to_texture;
  return attributes;
}

std::vector<Film> bake_at(SceneRenderer& renderer, std::span<const SurfacePoint> points,
                          RunObserver* observer) {
  const Plan& plan = renderer.plan();
  renderer.expect_rays(double(points.size()) * plan.directions * double(plan.effects.size()));
  return renderer.estimate(points, plan.directions, observer);
}

MeshBake bake_vertices(SceneRenderer& renderer, RunObserver* observer) {
  std::vector<vec3> normals = position_normals(renderer.mesh());
  const std::vector<SurfacePoint> points = vertex_points(renderer.mesh(), normals);
  return bake_points(renderer, std::move(normals), points, observer);
}

MeshBake bake_corners(SceneRenderer& renderer, RunObserver* observer) {
  CornerPoints corners = corner_points(renderer.mesh());
  return bake_points(renderer, std::move(corners.normals), corners.points, observer);
}

}  // namespace nook
