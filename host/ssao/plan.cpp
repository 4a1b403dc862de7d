#include "ssao/plan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"

namespace nook {
namespace {

using Method = SsaoSettings::Method;
using Quality = SsaoSettings::Quality;

// What each quality spends, chosen by measurement (docs/ssao.md): draft and real-time shade every fourth
// pixel, since directions shared by the denoiser and the upsample bring more than pixels do; accurate has all
// pixels, nine faces behind each and a wide guard band.
void spend(SsaoPlan& plan, Quality quality) {
  const bool accurate = quality == Quality::accurate, draft = quality == Quality::draft;
  plan.half_resolution = !accurate;
  plan.denoise_radius = 2;
  plan.depth_tolerance = accurate ? 0.003f : 0.01f;
  plan.normal_tolerance = accurate ? 0.1f : draft ? 0.0f : 0.2f;
  plan.guard = accurate ? 0.5f : draft ? 0.0f : 0.1f;
  plan.layers = accurate ? 9 : 2;
  switch (plan.method) {
    case Method::point:
      plan.cosine = plan.range_check = true;
      plan.layers = 1;
      plan.directions = accurate ? 32 : draft ? 8 : 16;
      break;
    case Method::gtao:
      plan.directions = accurate ? 8 : draft ? 1 : 2;
      plan.steps = accurate ? 12 : 4;
      break;
    case Method::march:
      plan.directions = accurate ? 32 : draft ? 4 : 8;
      plan.steps = accurate ? 16 : draft ? 4 : 8;
      break;
  }
  // The longest of march's steps at accurate quality (glsl/march.frag): what is as thick is not stepped over.
  plan.thickness = 1.5f / 15;
}

}  // namespace

SsaoPlan plan_ssao(const SsaoSettings& settings, const Bounds3& bounds) {
  if (settings.samples < 1 || settings.samples > 32)
    throw Error(ErrorKind::scene, "SSAO takes 1 to 32 samples, not " + std::to_string(settings.samples));
  if (!(settings.radius >= 0) || !std::isfinite(settings.radius))
    throw Error(ErrorKind::scene, "the SSAO radius must be a finite number and not negative");
  if (!(settings.bias >= 0) || !std::isfinite(settings.bias))
    throw Error(ErrorKind::scene, "the SSAO bias must be a finite number and not negative");
  SsaoPlan plan;
  plan.method = settings.method;
  plan.radius = settings.radius > 0 ? settings.radius : 0.5f * bounds.bounding_radius();
  plan.bias = settings.bias;
  plan.range_check = settings.range_check;
  if (settings.quality || settings.method != Method::point)
    spend(plan, settings.quality.value_or(Quality::real_time));
  else
    plan.directions = settings.samples;
  plan.directions = std::min(plan.directions, settings.samples);
  return plan;
}

}  // namespace nook
