#include "report/scene_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mesh/mesh_analysis.hpp"
#include "plan/plan.hpp"
#include "scene/effect_keys.hpp"
#include "scene/layer_names.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

// Each file once, in the scene's order.
std::vector<std::string> mesh_files(const Scene& scene) {
  if (scene.instances.empty()) return {scene.mesh_file.string()};
  std::vector<std::string> files;
  for (const Instance& instance : scene.instances)
    if (std::find(files.begin(), files.end(), instance.mesh_file.string()) == files.end())
      files.push_back(instance.mesh_file.string());
  return files;
}

std::vector<SceneInfo::EffectInfo> effects_of(const Scene& scene, const TriangleMesh& mesh) {
  std::vector<SceneInfo::EffectInfo> made;
  const std::vector<std::string> prefixes = layer_prefixes(scene);
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const Effect& effect = scene.effects[e];
    SceneInfo::EffectInfo info{effect_label(effect.kind, prefixes[e]),
                               std::string(name_of(effect.kind)),
                               settings_text(effect),
                               0,
                               "",
                               is_traced(effect.kind)};
    if (info.traced) {
      const bool compat =
          effect.max_distance.kind == DistanceLimit::Kind::automatic && scene.compat_tinyrender;
      info.max_distance = resolve_distance(effect, subject_radius(mesh), scene.compat_tinyrender);
      info.limit_from = compat ? "compat = tinyrender" : to_string(effect.max_distance);
    }
    made.push_back(std::move(info));
  }
  return made;
}

// 0.1 and not 0.100000001.
double decimal(float value) {
  return std::stod(fmt::format("{}", value));
}

nlohmann::json list(const dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

SceneInfo scene_info(const Scene& scene, const TriangleMesh& mesh, bool targets) {
  const MeshAnalysis analysis = analyse(mesh);
  SceneInfo made;
  made.meshes = mesh_files(scene);
  made.triangles = mesh.scene_triangles();
  made.positions = mesh.positions.size();
  made.groups = mesh.groups.size();
  made.materials = mesh.materials.size();
  if (!mesh.instances.empty()) {
    made.instances = mesh.instances.size();
    made.models = mesh.models.size();
    made.model_triangles = mesh.triangles.size();
  }
  made.frame = mesh.frame;
  made.lo = mesh.frame.to_file(dvec3(mesh.bounds.lo));
  made.hi = mesh.frame.to_file(dvec3(mesh.bounds.hi));
  made.center = mesh.frame.to_file(dvec3(mesh.bounds.center()));
  made.radius = mesh.frame.to_file(double(mesh.bounds.bounding_radius()));
  made.has_normals = mesh.has_normals();
  made.normals = mesh.normals.size();
  made.corners_without_normal = mesh.report.normals_replaced;
  made.normals_normalised = mesh.report.normals_normalised;
  made.zero_area = analysis.zero_area;
  made.duplicates = analysis.duplicates;
  made.non_finite_dropped = mesh.report.non_finite_dropped;
  made.width = scene.width;
  made.height = scene.height;
  made.window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  made.effects = effects_of(scene, mesh);
  made.sampled = std::any_of(made.effects.begin(), made.effects.end(),
                             [](const SceneInfo::EffectInfo& effect) { return effect.traced; });
  made.targets = targets;
  made.camera_rays = targets ? scene.stop.max_spp : scene.spp;
  made.directions = scene.directions;
  made.chooses_directions = scene.chooses_directions();
  made.seed = scene.seed;
  made.sampler = name_of(scene.sampler);
  return made;
}

std::string info_json(const SceneInfo& info) {
  nlohmann::json json = {{"meshes", info.meshes},
                         {"triangles", info.triangles},
                         {"positions", info.positions},
                         {"groups", info.groups},
                         {"materials", info.materials},
                         {"bounds", {list(info.lo), list(info.hi)}},
                         {"bounding_sphere", {{"center", list(info.center)}, {"radius", info.radius}}},
                         {"zero_area", info.zero_area},
                         {"duplicates", info.duplicates},
                         {"non_finite_dropped", info.non_finite_dropped},
                         {"width", info.width},
                         {"height", info.height},
                         {"crop", {info.window.x0, info.window.x1, info.window.y0, info.window.y1}},
                         {"effects", nlohmann::json::array()}};
  if (info.instances)
    json["instances"] = {
        {"count", info.instances}, {"meshes", info.models}, {"triangles", info.model_triangles}};
  if (info.frame != Frame())
    json["frame"] = {{"center", list(info.frame.center)}, {"exponent", info.frame.exponent}};
  if (info.has_normals)
    json["normals"] = {{"count", info.normals},
                       {"corners_without", info.corners_without_normal},
                       {"not_of_unit_length", info.normals_normalised}};
  if (info.sampled) {
    json[info.targets ? "max_spp" : "spp"] = info.camera_rays;
    json["directions"] = info.chooses_directions ? nlohmann::json("auto") : nlohmann::json(info.directions);
    json["sampler"] = info.sampler;
    json["seed"] = info.seed;
  }
  for (const SceneInfo::EffectInfo& effect : info.effects) {
    nlohmann::json entry = {{"name", effect.name}, {"type", effect.type}, {"settings", effect.settings}};
    if (effect.traced) {
      entry["max_distance"] =
          std::isinf(effect.max_distance) ? nlohmann::json() : nlohmann::json(decimal(effect.max_distance));
      entry["max_distance_from"] = effect.limit_from;
    }
    json["effects"].push_back(std::move(entry));
  }
  return json.dump(2);
}

}  // namespace nook
