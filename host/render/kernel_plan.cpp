#include "render/kernel_plan.hpp"

namespace nook {

KernelPlan primary_kernel(const Plan& plan) {
  KernelPlan kernel{"primary.cl", "primary", {}};
  kernel.options.define("SAMPLER", long(plan.sampler)).define("VERTEX_NORMALS", plan.vertex_normals);
  if (plan.materials) kernel.options.define("MATERIALS", 1);
  return kernel;
}

KernelPlan occlusion_kernel(const Plan& plan, const EffectPlan& effect) {
  KernelPlan kernel{"occlusion.cl", "occlusion", {}};
  kernel.options.define("EFFECT", effect.effect.kind == EffectKind::ro)
      .define("SAMPLING", long(effect.effect.sampling))
      .define("SAMPLER", long(plan.sampler))
      .define("REPLICATE_DIRECTIONS", plan.replicate_directions);
  if (effect.effect.kind == EffectKind::ro && effect.effect.exponent_of_material) kernel.options.define("EXPONENT_OF_MATERIAL", 1);
  return kernel;
}

}  // namespace nook
