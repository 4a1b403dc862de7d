#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "adaptive/adaptive.hpp"
#include "adaptive/stop_target.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Ends of a render other than a number of samples: --error, --time and what goes with them. They override
/// the scene's.
struct TargetOptions {
  std::optional<double> error, seconds, confidence;
  std::optional<std::uint32_t> min_spp, max_spp;
  bool dry_run = false;

  void add_to(CLI::App& command);
  /// What holds for a scene. `spp`: the flag was given; it replaces the scene's targets, and excludes those
  /// of other flags. Throws Error(usage) for flags that do not go together.
  StopTarget resolve(const Scene& scene, bool spp) const;
};

/// The plan for print_forecast().
Plan plan_to_forecast(const StopTarget& stop, const Plan& plan);

/// Prints what errors of .05, .02, .01, .005 and the one asked for would take.
void print_forecast(OcclusionTracer& tracer, const Plan& plan, const StopTarget& stop);

}  // namespace nook
