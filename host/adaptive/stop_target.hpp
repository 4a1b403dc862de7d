#pragma once

#include "adaptive/stop_rule.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The target of the stop rules; `stop` has an error.
ErrorTarget error_target(const StopTarget& stop);

/// The plan to render by: the samples a pixel may have, and the sampler that a stop rule needs.
Plan plan_until(const StopTarget& stop, const Plan& plan);

}  // namespace nook
