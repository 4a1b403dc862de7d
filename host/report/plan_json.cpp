#include "report/plan_json.hpp"

#include <nlohmann/json.hpp>

#include "plan/kernel_arguments.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {

std::string channels_text(const LayerPlan& layer) {
  if (layer.prefix.empty()) return "R,G,B";
  if (layer.kind == EffectKind::bent) return layer.prefix + "X,Y,Z,cone,AO";
  return layer.prefix + (layer.kind == EffectKind::depth ? "Z" : is_surface(layer.kind) ? "X,Y,Z" : "R,G,B");
}

std::string plan_json(const Plan& plan, const TriangleMesh& mesh, const PlanReport& report) {
  nlohmann::json json = {{"width", plan.window.width()},        {"height", plan.window.height()},
                         {"triangles", mesh.scene_triangles()}, {"libraries", report.libraries},
                         {"left_out", report.left_out},         {"kernels", nlohmann::json::array()},
                         {"buffers", nlohmann::json::array()}};
  if (!plan.effects.empty()) {
    json["spp"] = plan.spp;
    json["directions"] = plan.directions;
  }
  for (const auto& [name, text] : report.picture) json["picture"][name] = text;
  auto traced = plan.effects.begin();
  for (const LayerPlan& layer : plan.layers) {
    nlohmann::json entry = {{"channels", channels_text(layer)}, {"type", name_of(layer.kind)}};
    if (layer.kind != EffectKind::ssao && !is_surface(layer.kind))
      entry["settings"] = settings_text((traced++)->resolved());
    json["layers"].push_back(entry);
  }
  for (const PassReport& pass : report.passes)
    json["passes"].push_back({{"name", pass.name}, {"what", pass.what}, {"rays_at_most", pass.rays}});
  for (const KernelPlan& kernel : report.kernels)
    json["kernels"].push_back({{"file", kernel.file},
                               {"options", kernel.options.text()},
                               {"arguments", argument_names(plan, kernel.entry)}});
  for (const BufferReport& buffer : report.buffers)
    json["buffers"].push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
  return json.dump(2);
}

}  // namespace nook
