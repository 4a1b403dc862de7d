#include "report/run_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/pending_file.hpp"
#include "base/version.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

std::string distance_text(float distance) {
  return std::isinf(distance) ? "none" : fmt::format("{}", distance);
}

nlohmann::json effect_json(const EffectPlan& effect) {
  nlohmann::json json = {{"type", name_of(effect.effect.kind)},
                         {"sampling", name_of(effect.effect.sampling)}};
  if (std::isinf(effect.max_distance))
    json["max_distance"] = "none";
  else
    json["max_distance"] = effect.max_distance;
  if (effect.effect.kind == EffectKind::ro && effect.effect.exponent_of_material)
    json["exponent"] = "material";
  else if (effect.effect.kind == EffectKind::ro)
    json["exponent"] = effect.effect.exponent;
  return json;
}

void add_ssao_metadata(std::map<std::string, std::string>& m, const std::string& prefix,
                       const SsaoRecord& record) {
  const SsaoPlan& plan = record.plan;
  m[prefix + "effect"] = "ssao";
  m[prefix + "method"] = name_of(plan.method);
  m[prefix + "quality"] = record.settings.quality ? name_of(*record.settings.quality) : "none";
  m[prefix + "radius"] = fmt::format("{}", plan.radius);
  m[prefix + "bias"] = fmt::format("{}", plan.bias);
  m[prefix + (plan.method == SsaoSettings::Method::gtao ? "slices" : "ssao_directions")] =
      std::to_string(plan.directions);
  m[prefix + "steps"] = std::to_string(plan.steps);
  m[prefix + "depth_layers"] = std::to_string(plan.layers);
  m[prefix + "seconds_per_frame"] = fmt::format("{:.4f}", record.seconds_per_frame);
}

nlohmann::json ssao_json(const SsaoRecord& record) {
  nlohmann::json passes;
  for (const SsaoTiming& pass : record.passes) passes[pass.pass] = pass.seconds;
  return {{"type", "ssao"},
          {"method", name_of(record.plan.method)},
          {"radius", record.plan.radius},
          {"frames", record.frames},
          {"seconds_per_frame", record.seconds_per_frame},
          {"passes", passes}};
}

}  // namespace

std::map<std::string, std::string> RunRecord::metadata() const {
  std::map<std::string, std::string> m;
  m["nook/version"] = version;
  m["nook/build"] = build_description;
  m["nook/scene_file"] = scene_file;
  m["nook/scene_hash"] = scene_hash;
  m["nook/mesh_hash"] = mesh_hash;
  m["nook/sampler"] = name_of(plan.sampler);
  m["nook/seed"] = std::to_string(plan.seed);
  m["nook/spp"] = std::to_string(plan.spp);
  m["nook/directions"] = std::to_string(plan.directions);
  for (std::size_t e = 0; e < plan.effects.size(); ++e) {
    const EffectPlan& effect = plan.effects[e];
    const std::string prefix = e == 0 ? "nook/" : fmt::format("nook/effect{}/", e + 1);
    m[prefix + "effect"] = name_of(effect.effect.kind);
    m[prefix + "sampling"] = name_of(effect.effect.sampling);
    m[prefix + "max_distance"] = distance_text(effect.max_distance);
    if (effect.effect.kind == EffectKind::ro)
      m[prefix + "exponent"] =
          effect.effect.exponent_of_material ? "material" : fmt::format("{}", effect.effect.exponent);
  }
  if (plan.denoise) m["nook/denoised"] = "a-trous";
  for (std::size_t e = 0; e < ssao.size(); ++e) {
    const std::size_t index = plan.effects.size() + e;
    add_ssao_metadata(m, index == 0 ? "nook/" : fmt::format("nook/effect{}/", index + 1), ssao[e]);
  }
  if (error) {
    if (error->asked > 0) m["nook/error_asked"] = fmt::format("{}", error->asked);
    m["nook/error_reached"] = fmt::format("{:.6g}", error->reached);
  }
  m["nook/device"] = device.name;
  m["nook/driver"] = device.platform_name + " " + device.driver;
  m["nook/seconds_load"] = fmt::format("{:.4f}", seconds.load);
  m["nook/seconds_bvh"] = fmt::format("{:.4f}", seconds.bvh);
  m["nook/seconds_compile"] = fmt::format("{:.4f}", seconds.compile);
  m.merge(count_metadata(counts, seconds.render));
  return m;
}

std::map<std::string, std::string> count_metadata(const TraceCounts& counts, double render_seconds) {
  return {{"nook/seconds_render", fmt::format("{:.4f}", render_seconds)},
          {"nook/camera_rays", std::to_string(counts.camera_rays)},
          {"nook/occlusion_rays", std::to_string(counts.occlusion_rays)},
          {"nook/rejected_samples", std::to_string(counts.rejected)}};
}

void write_stats(const std::filesystem::path& path, const RunRecord& r) {
  nlohmann::json json = {
      {"version", version},
      {"scene", r.scene_file},
      {"scene_hash", r.scene_hash},
      {"mesh_hash", r.mesh_hash},
      {"complete", r.complete},
      {"width", r.plan.window.width()},
      {"height", r.plan.window.height()},
      {"spp", r.plan.spp},
      {"directions", r.plan.directions},
      {"sampler", name_of(r.plan.sampler)},
      {"seed", r.plan.seed},
      {"device",
       {{"name", r.device.name}, {"platform", r.device.platform_name}, {"driver", r.device.driver}}},
      {"triangles", r.triangles},
      {"bytes_uploaded", r.bytes_uploaded},
      {"kernels_built", r.kernels_built},
      {"kernels_from_cache", r.kernels_from_cache},
      {"libraries", r.libraries},
      {"rays", {{"camera", r.counts.camera_rays}, {"occlusion", r.counts.occlusion_rays}}},
      {"rejected_samples", r.counts.rejected},
      {"launches", r.launches},
      {"seconds_on_device", r.device_seconds},
      {"seconds",
       {{"load", r.seconds.load},
        {"bvh", r.seconds.bvh},
        {"compile", r.seconds.compile},
        {"render", r.seconds.render},
        {"write", r.seconds.write},
        {"before_first_ray", r.seconds.before_first_ray},
        {"total", r.seconds.total}}}};
  if (r.error)
    json["error"] = {{"asked", r.error->asked > 0 ? nlohmann::json(r.error->asked) : nlohmann::json()},
                     {"confidence", r.error->confidence},
                     {"reached", r.error->reached},
                     {"worst", r.error->worst},
                     {"share_done", r.error->share_done}};
  for (std::size_t e = 0; e < r.plan.effects.size(); ++e) {
    json["effects"].push_back(effect_json(r.plan.effects[e]));
    if (e < r.effect_rays.size()) json["effects"].back()["rays"] = r.effect_rays[e];
  }
  for (const SsaoRecord& record : r.ssao) json["effects"].push_back(ssao_json(record));
  const std::string text = json.dump(2) + '\n';
  PendingFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace nook
