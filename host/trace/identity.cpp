#include "trace/identity.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include "base/version.hpp"
#include "device/kernel_source.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

std::string kernel_hash() {
  const std::string source = kernel_source("stage/primary.cl") + kernel_source("stage/occlusion.cl");
  const XXH128_hash_t hash = XXH3_128bits(source.data(), source.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

FilmPart::Texts film_identity(const Plan& plan, const DeviceInfo& device, const std::string& scene_hash,
                              const std::string& mesh_hash, const FilmPart::Texts& extra) {
  FilmPart::Texts identity;
  const auto add = [&](const std::string& name, auto value) {
    identity.emplace_back(name, fmt::format("{}", value));
  };
  add("version", version);
  add("build", build_description);
  add("size", fmt::format("{}x{}", plan.width, plan.height));
  add("crop", fmt::format("{},{},{},{}", plan.window.x0, plan.window.x1, plan.window.y0, plan.window.y1));
  add("spp", plan.spp);
  add("directions", plan.directions);
  add("sampler", name_of(plan.sampler));
  add("seed", plan.seed);
  for (const EffectPlan& effect : plan.effects) {
    add("effect", name_of(effect.effect.kind));
    for (const auto& [key, value] : settings_of(effect.resolved()))
      add(std::string(key->recorded_as()), plain_text(value));
  }
  identity.insert(identity.end(), extra.begin(), extra.end());
  add("scene", scene_hash);
  add("mesh", mesh_hash);
  add("kernels", kernel_hash());
  add("device", device.name);
  add("driver", device.platform_name + " " + device.driver);
  return identity;
}

}  // namespace nook
