#pragma once

#include <string>

#include "plan/plan_report.hpp"

namespace nook {

/// A layer's channels: "R,G,B", "contact.X,Y,Z,cone,AO".
std::string channels_text(const LayerPlan& layer);

/// What `nook plan --json` prints: the plan of a scene of that mesh.
std::string plan_json(const Plan& plan, const TriangleMesh& mesh, const PlanReport& report);

}  // namespace nook
