#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "plan/scene_camera.hpp"
#include "scene/effect_keys.hpp"
#include "scene/layer_names.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

// The largest weight that kernels/effect/ambient.cl and kernels/effect/reflection.cl can return.
double weight_bound(const Effect& effect, double n) {
  if (effect.kind != EffectKind::ro)
    return effect.sampling == Sampling::sphere ? 4 : effect.sampling == Sampling::hemisphere ? 2 : 1;
  switch (effect.sampling) {
    case Sampling::cosine:
      return std::max(1.0, (n + 2) / 2);
    case Sampling::hemisphere:
      return n + 2;
    case Sampling::sphere:
      return 2 * (n + 2);
    case Sampling::mixture:
      return 4;
    default:
      return 2;
  }
}

bool any_lobe_of_material(const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [](const Effect& e) { return e.kind == EffectKind::ro && e.exponent_of_material; });
}

// Asking pays where the answer is often no: within a part of the scene's radius.
constexpr float reach_of_radius = 0.25f;

std::vector<float> exponents_of(const Scene& scene, const TriangleMesh& mesh) {
  std::vector<float> exponents;
  for (const Material& material : mesh.materials) exponents.push_back(material.phong_exponent);
  if (std::none_of(exponents.begin(), exponents.end(), [](float n) { return n >= 0; }))
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                "exponent = \"material\" needs a material with a lobe (Ns in the MTL file), and " +
                    scene.mesh_file.string() + " has none");
  return exponents;
}

// Where in `sets` the set is, from 1; appended if it is new.
std::size_t index_of_set(std::vector<std::uint32_t> set, std::vector<std::vector<std::uint32_t>>& sets) {
  const auto found = std::find(sets.begin(), sets.end(), set);
  const auto index = std::size_t(found - sets.begin()) + 1;
  if (found == sets.end()) sets.push_back(std::move(set));
  return index;
}

// Settings that exclude one another, wherever they came from: scene file or command line.
void check(const Scene& scene, const EffectPlan& planned) {
  const Effect& effect = planned.effect;
  const auto reject = [&](const std::string& what) {
    throw Error(ErrorKind::scene, Place{scene.file.string()}, what);
  };
  if (effect.falloff != Falloff::none && !(planned.max_distance > 0 && std::isfinite(planned.max_distance)))
    reject("falloff = \"" + std::string(name_of(effect.falloff)) +
           "\" needs a max_distance above 0, and a finite one");
  if (effect.min_distance > 0 && !(effect.min_distance < planned.max_distance))
    reject("min_distance must be below max_distance");
  if (const auto conflict = conflict_of(effect)) reject(std::string(conflict->key) + " " + conflict->what);
}

}  // namespace

Effect EffectPlan::resolved() const {
  Effect known = effect;
  known.max_distance = std::isinf(max_distance) ? DistanceLimit{DistanceLimit::Kind::none, 0}
                                                : DistanceLimit{DistanceLimit::Kind::value, max_distance};
  return known;
}

std::map<std::string, std::string> EffectPlan::settings() const {
  std::map<std::string, std::string> texts;
  for (const auto& [key, value] : settings_of(resolved()))
    texts[std::string(key->recorded_as())] = plain_text(value);
  return texts;
}

std::string EffectPlan::label() const {
  return effect_label(effect.kind, layer);
}

bool Plan::only_self() const {
  return std::any_of(effects.begin(), effects.end(), [](const EffectPlan& e) { return e.effect.only_self; });
}

bool Plan::asks_reach() const {
  return std::any_of(effects.begin(), effects.end(), [](const EffectPlan& e) { return e.reach; });
}

void check_samples(const Scene& scene, std::uint64_t spp) {
  const std::uint64_t samples = spp * scene.directions;
  if (samples > most_samples_per_pixel)
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                fmt::format("{} camera rays x {} directions are {} samples a pixel, at most {}", spp,
                            scene.directions, samples, most_samples_per_pixel));
}

MeshAttributes needed_attributes(const Scene& scene, bool surface) {
  MeshAttributes needs{.normals = surface};
  for (const Effect& effect : scene.effects)
    needs.normals =
        needs.normals || (effect.kind != EffectKind::position && effect.kind != EffectKind::depth);
  needs.materials = any_lobe_of_material(scene) || scene.cutouts;
  needs.exponents = any_lobe_of_material(scene);
  needs.uvs = scene.cutouts;
  for (const Effect& effect : scene.effects) {
    const bool names = !effect.occluders.empty() || !effect.receivers.empty();
    needs.groups = needs.groups || names || effect.only_self;
    needs.materials = needs.materials || names;
  }
  return needs;
}

float subject_radius(const TriangleMesh& mesh) {
  return float(mesh.frame.to_file(double(mesh.subject_bounds().bounding_radius())));
}

float resolve_distance(const Effect& effect, float radius, bool compat_tinyrender) {
  switch (effect.max_distance.kind) {
    case DistanceLimit::Kind::none:
      return std::numeric_limits<float>::infinity();
    case DistanceLimit::Kind::value:
      return effect.max_distance.value;
    default:
      if (effect.kind == EffectKind::ro) return std::numeric_limits<float>::infinity();
      return compat_tinyrender ? 1.5f : 0.5f * radius;
  }
}

void choose_scales(EffectPlan& effect, float largest_exponent) {
  effect.weight_bound = weight_bound(effect.effect, largest_exponent);
  const int bits = std::max(0, int(std::ceil(std::log2(effect.weight_bound))) - 2);
  effect.sum_scale = std::ldexp(1.0f, 32 - bits);
  effect.square_scale = std::ldexp(1.0f, 30 - 2 * bits);
}

namespace {

// Of a picture of occlusion that is not shown as it is.
std::optional<std::uint32_t> ground_of_preview(const Scene& scene, const TriangleMesh& mesh) {
  const EffectKind kind = scene.effects[main_effect(scene)].kind;
  if (mesh.subject.empty() || scene.background == Background{}) return {};
  if (kind != EffectKind::ao && kind != EffectKind::ro) return {};
  return std::uint32_t(mesh.scene_triangles() - 2);
}

// What a pilot chooses where most of the noise is between directions.
constexpr std::uint32_t likely_directions = 16;

}  // namespace

Plan make_plan(const Scene& scene, const TriangleMesh& mesh, bool surface) {
  Plan plan;
  plan.camera = camera_params(scene, mesh);
  plan.frame = mesh.frame;
  plan.width = scene.width;
  plan.height = scene.height;
  plan.window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  plan.spp = scene.spp;
  plan.choose_directions = scene.chooses_directions();
  plan.directions = plan.choose_directions ? likely_directions : scene.directions;
  plan.replicate_directions = scene.spp == 1 && !plan.choose_directions;
  plan.sampler = scene.sampler;
  plan.seed = scene.seed;
  plan.surface = surface;
  plan.cutouts = !mesh.opacity_maps.empty();
  plan.instances = !mesh.instances.empty();
  if (any_lobe_of_material(scene)) plan.exponents = exponents_of(scene, mesh);
  plan.materials = !plan.exponents.empty();
  const std::vector<std::string> prefixes = layer_prefixes(scene);
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const Effect& effect = scene.effects[e];
    const LayerPlan layer{effect.kind, prefixes[e], e == main_effect(scene)};
    if (is_surface(effect.kind)) {
      plan.surface = true;
    } else if (effect.kind == EffectKind::ssao) {
      plan.ssao.push_back(effect.ssao);
    } else {
      EffectPlan planned;
      planned.layer = layer.prefix;
      planned.effect = effect;
      planned.max_distance = resolve_distance(effect, subject_radius(mesh), scene.compat_tinyrender);
      planned.reach = planned.max_distance <= reach_of_radius * subject_radius(mesh);
      choose_scales(planned, effect.kind == EffectKind::ro && effect.exponent_of_material
                                 ? *std::max_element(plan.exponents.begin(), plan.exponents.end())
                                 : effect.exponent);
      check(scene, planned);
      if (!effect.occluders.empty())
        planned.tree = index_of_set(triangles_of(named_triangles(scene, mesh, "occluders", effect.occluders)),
                                    plan.occluder_sets);
      if (!effect.receivers.empty())
        planned.receivers = named_triangles(scene, mesh, "receivers", effect.receivers);
      plan.effects.push_back(planned);
    }
    plan.layers.push_back(layer);
  }
  plan.denoise = scene.denoise && !plan.effects.empty();
  plan.preview_ground = ground_of_preview(scene, mesh);
  plan.surface = plan.surface || plan.denoise || plan.preview_ground;
  plan.vertex_normals =
      mesh.has_normals() && plan.needs_opencl() && needed_attributes(scene, surface).normals;
  return plan;
}

}  // namespace nook
