#include "app/target_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/interrupt.hpp"
#include "base/error.hpp"
#include "render/forecast.hpp"

namespace nook {

void TargetOptions::add_to(CLI::App& command) {
  const CLI::Range samples(1, 1 << 26);
  const char* group = "Stop rules";
  command
      .add_option("--error", error, "Render until every pixel's standard error is this; spp follows from it")
      ->check(CLI::Range(1e-4, 1.0))
      ->envname("NOOK_ERROR")
      ->group(group);
  command.add_option("--confidence", target.confidence, "Of the intervals behind --error; default 0.95")
      ->check(CLI::Range(0.5, 0.9999))
      ->envname("NOOK_CONFIDENCE")
      ->group(group);
  command
      .add_option("--time", seconds,
                  "Seconds from the start of the command after which the picture is written, as good as it "
                  "is by then")
      ->check(CLI::Range(0.05, 1e7))
      ->envname("NOOK_TIME")
      ->group(group);
  command
      .add_option("--min-spp", target.min_spp,
                  "With --error: camera rays before a pixel may stop; default 16")
      ->check(samples)
      ->group(group);
  command
      .add_option("--max-spp", target.max_spp,
                  "With --error or --time: camera rays a pixel at most; default 65536")
      ->check(samples)
      ->group(group);
  command
      .add_flag("--dry-run", dry_run,
                "With --error: a pilot of a second or two, then the predicted time and spp; renders nothing")
      ->group(group);
}

void TargetOptions::check() const {
  // CLI::Range lets it pass.
  const std::pair<const char*, double> given[] = {
      {"--error", error.value_or(1)}, {"--time", seconds.value_or(1)}, {"--confidence", target.confidence}};
  for (const auto& [flag, value] : given)
    if (std::isnan(value)) throw Error(ExitCode::usage, fmt::format("{}: 'nan' is not a number", flag));
  if (dry_run && !error) throw Error(ExitCode::usage, "--dry-run: needs --error");
  if (target.min_spp > target.max_spp)
    throw Error(ExitCode::usage,
                fmt::format("--min-spp: {} is above --max-spp, {}", target.min_spp, target.max_spp));
}

ErrorTarget TargetOptions::error_target() const {
  ErrorTarget made = target;
  made.error = error.value_or(made.error);
  return made;
}

Plan TargetOptions::plan_for(const Plan& plan) const {
  if (error) return AdaptiveRender::plan_for(plan, error_target());
  Plan made = plan;
  if (seconds) {
    made.spp = std::max(2u, target.max_spp);
    made.replicate_directions = false;
  }
  return made;
}

// Stopping now ends after the launch under way, going on at least one later: the middle decides. The first
// launches also load code.
bool Deadline::reached() {
  if (!seconds_) return false;
  const Clock::time_point now = Clock::now();
  const auto launch = ++launches_ > 2 ? now - last_ : Clock::duration::zero();
  last_ = now;
  return std::chrono::duration<double>(now + launch + launch / 2 - start_).count() >= *seconds_;
}

Session::Schedule doublings() {
  return [](const Session& session) -> SampleBoxes {
    const SampleBox all = session.share({0, 1});
    const std::uint64_t taken =
        session.samples_held() / std::max<std::uint64_t>(1, all.pixel_end - all.pixel_begin);
    return {{all.pixel_begin, all.pixel_end, 0,
             std::uint32_t(std::min<std::uint64_t>(all.end, std::max<std::uint64_t>(1, 2 * taken)))}};
  };
}

ErrorRecord error_of(std::span<const Film> films) {
  ErrorRecord error;
  double square = 0, seen = 0;
  for (const Film& film : films)
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (film.hits[i] == 0) continue;
      const double variance = film.variance(i);
      square += variance;
      seen += 1;
      error.worst = std::max(error.worst, std::sqrt(variance));
    }
  error.reached = seen > 0 ? std::sqrt(square / seen) : 0;
  error.share_done = 1;
  return error;
}

AdaptiveResult render_to_error(AdaptiveRender& render, const PathTracer& tracer, Deadline deadline,
                               ProgressMode mode) {
  ProgressReporter progress(mode, 1);
  const AdaptiveResult result = render.run([&](const AdaptiveProgress& now) {
    progress.set_total(now.samples_done + std::uint64_t(now.samples_left));
    progress.set_note(fmt::format("{:.0f} % of the pixels done", 100 * now.share_done));
    progress.update(now.samples_done, tracer.counters().camera_rays + tracer.counters().occlusion_rays);
    return !interrupted() && !deadline.reached();
  });
  progress.finish();
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted; nothing was written");
  return result;
}

int announce_error(const ErrorRecord& error, bool quiet) {
  const bool missed = error.asked > 0 && (error.share_done < 1 || error.reached > error.asked);
  if (quiet && !missed) return 0;
  const std::string asked = error.asked > 0 ? fmt::format(" (asked: {}, {:.1f} % of the pixels done)",
                                                          error.asked, 100 * error.share_done)
                                            : "";
  fmt::print(stderr, "{}standard error {:.5f}, at most {:.5f}{}\n", missed ? "nook: target missed: " : "",
             error.reached, error.worst, asked);
  return missed ? int(ExitCode::target) : 0;
}

void print_forecast(PathTracer& tracer, const Plan& plan, const TargetOptions& options) {
  std::vector<double> errors = {.05, .02, .01, .005};
  if (std::find(errors.begin(), errors.end(), *options.error) == errors.end())
    errors.push_back(*options.error);
  std::sort(errors.begin(), errors.end(), std::greater<>());
  const Forecast made = forecast(tracer, plan, options.error_target(), errors, 1.5);
  fmt::print("{:>10}  {:>10}  {:>10}\n", "error", "spp", "seconds");
  for (const ForecastRow& row : made.rows)
    fmt::print("{:>10}  {:>10.0f}  {:>10.2f}\n", row.error, row.spp, row.seconds);
  fmt::print("pilot: {:.2f} s, {:.2f} million camera samples a second\n", made.pilot_seconds,
             made.samples_per_second * 1e-6);
}

}  // namespace nook
