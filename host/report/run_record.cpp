#include "report/run_record.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/pending_file.hpp"
#include "base/version.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

nlohmann::json json_of(const KeyValue& value) {
  return std::visit(
      [&](const auto& v) -> nlohmann::json {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::monostate>)
          return {};
        else if constexpr (std::is_same_v<T, float>)
          return std::stod(fmt::format("{}", v));  // 0.01 and not 0.00999999977
        else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string> ||
                           std::is_same_v<T, std::vector<std::string>>)
          return v;
        else
          return plain_text(value);
      },
      value);
}

nlohmann::json effect_json(const std::string& name, const Effect& effect) {
  nlohmann::json json = {{"name", name}, {"type", name_of(effect.kind)}};
  for (const auto& [key, value] : settings_of(effect)) json[std::string(key->recorded_as())] = json_of(value);
  return json;
}

// What was drawn: `quality` decides some of the settings.
Effect drawn_effect(const SsaoRecord& record) {
  Effect effect = default_effect(EffectKind::ssao);
  effect.ssao = record.settings;
  effect.ssao.method = record.plan.method;
  effect.ssao.radius = record.plan.radius;
  effect.ssao.bias = record.plan.bias;
  return effect;
}

nlohmann::json ssao_json(const SsaoRecord& record) {
  nlohmann::json json = effect_json(record.name, drawn_effect(record)), passes;
  for (const SsaoTiming& pass : record.passes) passes[pass.pass] = pass.seconds;
  json["frames"] = record.frames;
  json["seconds_per_frame"] = record.seconds_per_frame;
  json["passes"] = passes;
  return json;
}

void add_effect(std::map<std::string, std::string>& m, const std::string& prefix, const std::string& name,
                const Effect& effect) {
  m[prefix + "effect"] = name_of(effect.kind);
  m[prefix + "name"] = name;
  for (const auto& [key, value] : settings_of(effect))
    m[prefix + std::string(key->recorded_as())] = plain_text(value);
}

void add_ssao(std::map<std::string, std::string>& m, const std::string& prefix, const SsaoRecord& record) {
  const SsaoPlan& plan = record.plan;
  add_effect(m, prefix, record.name, drawn_effect(record));
  m[prefix + (plan.method == SsaoSettings::Method::gtao ? "slices" : "ssao_directions")] =
      std::to_string(plan.directions);
  m[prefix + "steps"] = std::to_string(plan.steps);
  m[prefix + "depth_layers"] = std::to_string(plan.layers);
  m[prefix + "seconds_per_frame"] = fmt::format("{:.4f}", record.seconds_per_frame);
}

// Effects are numbered: nook/..., nook/effect2/..., screen-space ones last.
std::string prefix_of(std::size_t effect) {
  return effect == 0 ? "nook/" : fmt::format("nook/effect{}/", effect + 1);
}

}  // namespace

std::map<std::string, std::string> RunRecord::metadata() const {
  std::map<std::string, std::string> m = repeat.attributes();
  m["nook/version"] = version;
  m["nook/build"] = build_description;
  m["nook/scene_file"] = scene_file;
  m["nook/scene_hash"] = scene_hash;
  m["nook/folder"] = folder;
  m["nook/sampler"] = name_of(plan.sampler);
  m["nook/seed"] = std::to_string(plan.seed);
  m["nook/spp"] = std::to_string(plan.spp);
  m["nook/directions"] = std::to_string(plan.directions);
  for (std::size_t e = 0; e < plan.effects.size(); ++e)
    add_effect(m, prefix_of(e), plan.effects[e].label(), plan.effects[e].resolved());
  if (plan.denoise) m["nook/denoised"] = "a-trous";
  for (std::size_t e = 0; e < ssao.size(); ++e) add_ssao(m, prefix_of(plan.effects.size() + e), ssao[e]);
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
      {"mesh_hash", r.repeat.mesh_hash},
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
        {"ssao", r.seconds.ssao},
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
    json["effects"].push_back(effect_json(r.plan.effects[e].label(), r.plan.effects[e].resolved()));
    if (e < r.effect_rays.size()) json["effects"].back()["rays"] = r.effect_rays[e];
  }
  for (const SsaoRecord& record : r.ssao) json["effects"].push_back(ssao_json(record));
  const std::string text = json.dump(2) + '\n';
  PendingFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace nook
