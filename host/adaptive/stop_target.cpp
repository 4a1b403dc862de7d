#include "adaptive/stop_target.hpp"

#include <algorithm>

#include "adaptive/adaptive.hpp"

namespace nook {

ErrorTarget error_target(const StopTarget& stop) {
  return {*stop.error, stop.confidence, stop.min_spp, stop.max_spp};
}

Plan plan_until(const StopTarget& stop, const Plan& plan) {
  if (stop.error) return AdaptiveRender::plan_for(plan, error_target(stop));
  Plan made = plan;
  if (stop.seconds) {
    made.spp = std::max(2u, stop.max_spp);
    made.replicate_directions = false;
  }
  return made;
}

}  // namespace nook
