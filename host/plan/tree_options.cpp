#include "plan/tree_options.hpp"

namespace nook {
namespace {

// Measured on two threads (bench/journal.md): rays whose twentieth takes twice as long as a refinement.
constexpr double rays_worth_refining = double(1u << 25);

}  // namespace

unsigned tree_width(const DeviceInfo& device, const Plan& plan) {
  return device.is_cpu() && device.native_float_width < 16 && !plan.asks_reach() ? 8 : 16;
}

double planned_rays(const Plan& plan) {
  return double(plan.window.width()) * plan.window.height() * plan.spp * plan.directions *
         double(plan.effects.size());
}

BvhOptions tree_options(const DeviceInfo& device, const Plan& plan, double rays, unsigned threads) {
  return {.threads = threads,
          .width = tree_width(device, plan),
          .refined = rays >= rays_worth_refining && !plan.asks_reach() && !plan.instances};
}

}  // namespace nook
