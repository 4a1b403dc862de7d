#pragma once

#include <span>
#include <vector>

#include "adaptive/adaptive.hpp"
#include "trace/deadline.hpp"

namespace nook {

/// What a render to a standard error of `error` would take.
struct ForecastRow {
  double error = 0;
  double spp = 0;      ///< camera samples a pixel, the mean over the window
  double seconds = 0;  ///< of rendering, on this device
};

struct Forecast {
  double pilot_seconds = 0;
  double samples_per_second = 0;  ///< camera samples
  std::vector<ForecastRow> rows;  ///< one per error asked about
};

/// Predicts AdaptiveRender from a pilot on every so-manieth run of 64 neighbouring pixels, which takes about
/// `seconds`: the samples each needs follow from its mean and variance, the time from the rate, which is the
/// median of several passes over those that see the mesh. tracer and plan as for AdaptiveRender with the
/// least of the errors. clock: what the seconds are of; the processor's time, say, on a machine with other
/// work.
Forecast forecast(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                  std::span<const double> errors, double seconds,
                  const Deadline::Clock& clock = Deadline::steady_seconds);

}  // namespace nook
