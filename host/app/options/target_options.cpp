#include "app/options/target_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "adaptive/forecast.hpp"
#include "app/options/key_flags.hpp"
#include "base/error.hpp"

namespace nook {

namespace {

constexpr double errors_forecast[] = {.05, .02, .01, .005};

}  // namespace

void TargetOptions::add_to(CLI::App& command) {
  const char* group = "Stop rules";
  const auto add = [&](const char* flag, auto& value) {
    add_key_flag(command, *key_of_flag(flag), value)->group(group);
  };
  add("--error", error);
  add("--confidence", confidence);
  add("--time", seconds);
  add("--min-spp", min_spp);
  add("--max-spp", max_spp);
  command
      .add_flag("--dry-run", dry_run,
                "With --error: a pilot of a second or two, then the predicted time and spp; renders nothing")
      ->group(group);
}

StopTarget TargetOptions::resolve(const Scene& scene, bool spp) const {
  const auto fail = [](const std::string& why) { throw Error(ErrorKind::usage, why); };
  if (spp && (error || seconds))
    fail(fmt::format("--spp: excludes {}, which --max-spp bounds", error ? "--error" : "--time"));
  StopTarget stop = spp ? StopTarget{} : scene.stop;
  if (error) stop.error = error;
  if (seconds) stop.seconds = seconds;
  if (dry_run && !stop.error) fail("--dry-run: needs --error");
  if (confidence && !stop.error) fail("--confidence: goes with --error");
  if (min_spp && !stop.error) fail("--min-spp: goes with --error");
  if (max_spp && !stop.any()) fail("--max-spp: goes with --error or --time");
  if (confidence) stop.confidence = *confidence;
  if (max_spp) stop.max_spp = *max_spp;
  if (min_spp && *min_spp > stop.max_spp)
    fail(fmt::format("--min-spp: {} is above the largest number of camera rays, {}", *min_spp, stop.max_spp));
  stop.min_spp = std::min(min_spp.value_or(stop.min_spp), stop.max_spp);
  return stop;
}

Plan plan_to_forecast(const StopTarget& stop, const Plan& plan) {
  StopTarget least = stop;
  for (const double error : errors_forecast) least.error = std::min(*least.error, error);
  return plan_until(least, plan);
}

void print_forecast(OcclusionTracer& tracer, const Plan& plan, const StopTarget& stop) {
  std::vector<double> errors(std::begin(errors_forecast), std::end(errors_forecast));
  if (std::find(errors.begin(), errors.end(), *stop.error) == errors.end()) errors.push_back(*stop.error);
  std::sort(errors.begin(), errors.end(), std::greater<>());
  const Forecast made = forecast(tracer, plan, error_target(stop), errors, 1.5);
  fmt::print("{:>10}  {:>10}  {:>10}\n", "error", "spp", "seconds");
  for (const ForecastRow& row : made.rows)
    fmt::print("{:>10}  {:>10.0f}  {:>10.2f}\n", row.error, row.spp, row.seconds);
  fmt::print("pilot: {:.2f} s, {:.2f} million camera samples a second\n", made.pilot_seconds,
             made.samples_per_second * 1e-6);
}

}  // namespace nook
