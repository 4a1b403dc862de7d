#include "ssao/plan.hpp"

#include <cmath>
#include <string>

#include "base/error.hpp"

namespace nook {

SsaoPlan plan_ssao(const SsaoSettings& settings, const Bounds3& bounds) {
  if (settings.samples < 1 || settings.samples > 32)
    throw Error(ExitCode::scene, "SSAO takes 1 to 32 samples, not " + std::to_string(settings.samples));
  if (!(settings.radius >= 0) || !std::isfinite(settings.radius))
    throw Error(ExitCode::scene, "the SSAO radius must be a finite number and not negative");
  if (!(settings.bias >= 0) || !std::isfinite(settings.bias))
    throw Error(ExitCode::scene, "the SSAO bias must be a finite number and not negative");
  SsaoPlan plan;
  plan.method = settings.method;
  plan.radius = settings.radius > 0 ? settings.radius : 0.5f * bounds.bounding_radius();
  plan.bias = settings.bias;
  plan.range_check = settings.range_check;
  plan.directions = settings.samples;
  return plan;
}

}  // namespace nook
