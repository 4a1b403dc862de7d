#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "adaptive/adaptive.hpp"
#include "trace/deadline.hpp"

namespace nook {

/// A few pixels rendered as AdaptiveRender does with randomised sequences, to predict what all of them will
/// need.
class ReplicatedPilot {
 public:
  /// tracer and plan as for AdaptiveRender; positions: in pixels_in_order(), ascending.
  ReplicatedPilot(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                  std::vector<std::uint32_t> positions);

  /// Runs stage after stage until `go_on` says no, at least three. Returns the camera samples a second of the
  /// last three stages, which are the largest.
  double run(const std::function<bool()>& go_on, const Deadline::Clock& clock);

  /// The mean over pixels of the camera samples that each needs for another error: those of the first stage
  /// at which its interval was narrow enough, or else extrapolated along the slope of the pixels' variance.
  double samples_for(double error) const;
  /// The same for an error that is rendered to by counts (AdaptiveRender::plan_for()).
  double samples_as_counts(double error) const;

 private:
  void remember();
  double rate() const;

  ErrorTarget target_;
  Randomisations randomisations_;
  std::vector<std::unique_ptr<PixelRule>> rules_;
  Session session_;
  std::vector<std::uint32_t> positions_;
  bool background_only_ = false;
  std::vector<std::uint32_t> stages_;             // camera samples of a pixel after each
  std::vector<std::vector<double>> half_widths_;  // by stage, then pixel (the widest effect's)
};

}  // namespace nook
