#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <optional>

#include "app/progress.hpp"
#include "render/adaptive.hpp"
#include "render/session.hpp"
#include "report/run_record.hpp"

namespace nook {

/// Ends of a render other than a number of samples: --error, --time and what goes with them.
struct TargetOptions {
  std::optional<double> error, seconds;
  ErrorTarget target;
  bool dry_run = false;

  void add_to(CLI::App& command);
  bool any() const { return error || seconds; }
  /// Throws Error(usage) for options that do not go together.
  void check() const;
  /// The target with the error asked for.
  ErrorTarget error_target() const;
  /// The plan to render by: the samples a pixel may have, and the sampler that a stop rule needs.
  Plan plan_for(const Plan& plan) const;
};

/// A moment to be finished by, and when to stop for it, given that at the end of each launch another is
/// already under way.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;
  /// seconds from `start`; none: never.
  Deadline(Clock::time_point start, std::optional<double> seconds)
      : start_(start), seconds_(seconds), last_(Clock::now()) {}
  /// True when to stop now ends nearer to that moment than to go on. Call it after each launch.
  bool reached();

 private:
  Clock::time_point start_;
  std::optional<double> seconds_;
  Clock::time_point last_;
  int launches_ = 0;
};

/// The schedule of a render that ends by time: 1, 2, 4, ... samples of every pixel, so that the picture is
/// even whenever it ends.
Session::Schedule doublings();

/// What a render that ended by time has reached, by the films' own variances.
ErrorRecord error_of(std::span<const Film> films);

/// Runs to the error or the deadline. Throws Error(interrupted).
AdaptiveResult render_to_error(AdaptiveRender& render, const PathTracer& tracer, Deadline deadline,
                               ProgressMode mode);

/// Says what was reached. Returns the exit code: ExitCode::target if less was asked for.
int announce_error(const ErrorRecord& error, bool quiet);

/// Prints what errors of .05, .02, .01, .005 and the one asked for would take.
void print_forecast(PathTracer& tracer, const Plan& plan, const TargetOptions& options);

}  // namespace nook
