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

/// Predicts AdaptiveRender from a pilot of about `seconds`, on runs of 64 neighbouring pixels that are spread
/// evenly over the picture. A pixel's mean and variance tell the samples that it needs. The rate tells the
/// time: the median of several passes over the pixels that see the mesh. tracer and plan: as for
/// AdaptiveRender with the least of the errors. clock: whose seconds are meant; on a machine with other work,
/// say, the processor's.
Forecast forecast(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                  std::span<const double> errors, double seconds,
                  const Deadline::Clock& clock = Deadline::steady_seconds);

}  // namespace nook
