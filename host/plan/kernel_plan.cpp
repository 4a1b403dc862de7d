#include "plan/kernel_plan.hpp"

#include <algorithm>

#include "scene/effect_keys.hpp"

namespace nook {

constexpr long given_points = 5;  // SAMPLER_POINTS of kernels/config.h: after those of nook::Sampler

KernelPlan primary_kernel(const Plan& plan) {
  KernelPlan kernel{"stage/primary.cl", "primary", {}};
  kernel.options.define("SAMPLER", long(plan.sampler)).define("VERTEX_NORMALS", plan.vertex_normals);
  if (plan.materials) kernel.options.define("MATERIALS", 1);
  if (plan.cutouts) kernel.options.define("CUT_OUTS", 1);
  if (plan.instances) kernel.options.define("INSTANCES", 1);
  return kernel;
}

KernelPlan occlusion_kernel(const Plan& plan, const EffectPlan& effect) {
  KernelPlan kernel{"stage/occlusion.cl", "occlusion", {}};
  kernel.options.define("EFFECT", effect.effect.kind == EffectKind::ro)
      .define("SAMPLING", long(effect.effect.sampling))
      .define("SAMPLER", plan.point_set.empty() ? long(plan.sampler) : given_points)
      .define("REPLICATE_DIRECTIONS", plan.replicate_directions);
  if (!plan.point_set.empty() && !plan.shift_points) kernel.options.define("POINTS_AS_THEY_ARE", 1);
  const Effect& e = effect.effect;
  if (e.kind == EffectKind::ro && e.exponent_of_material) kernel.options.define("EXPONENT_OF_MATERIAL", 1);
  for (const Key<Effect>& key : effect_keys()) {
    if (key.info.define.empty() || !key.info.readers.contains(e.kind)) continue;
    const auto words = key.info.domain.words;
    const std::string word = plain_text(key.field.get(e));
    const long number = std::find(words.begin(), words.end(), word) - words.begin();
    if (number != 0) kernel.options.define(std::string(key.info.define), number);
  }
  if (e.min_distance > 0) kernel.options.define("MIN_DISTANCE", 1);
  if (e.kind != EffectKind::ro && e.cone_angle < 90) kernel.options.define("CONE", 1);
  if (e.kind == EffectKind::bent) kernel.options.define("BENT", 1);
  if (effect.reach) kernel.options.define("REACH", 1);
  if (!effect.receivers.empty()) kernel.options.define("RECEIVERS", 1);
  if (e.only_self) kernel.options.define("ONLY_SELF", 1);
  if (plan.cutouts) kernel.options.define("CUT_OUTS", 1);
  if (plan.instances) kernel.options.define("INSTANCES", 1);
  if (e.kind == EffectKind::bent && e.view_space) kernel.options.define("BENT_VIEW", 1);
  return kernel;
}

}  // namespace nook
