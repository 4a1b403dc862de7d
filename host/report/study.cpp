#include "report/study.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "math/median.hpp"

namespace nook {
namespace {

constexpr double z95 = 1.959963984540054;

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / double(values.size());
}

template <class Get>
std::vector<double> of_runs(const StudyPoint& point, Get get) {
  std::vector<double> values;
  for (const StudyRun& run : point.runs) values.push_back(get(run));
  return values;
}

// About how many camera samples a level takes, for sorting and for the number of runs.
double effort(const StudyMethod& method, double level) {
  if (method.family == StudyMethod::Family::adaptive)
    return method.sampler == "independent" ? std::max(16.0, 0.15 / (level * level))
                                           : std::max(128.0, 0.4 * std::pow(level, -1.6));
  return method.family == StudyMethod::Family::ssao ? 0.1 * level
                                                    : level * std::sqrt(double(method.directions));
}

}  // namespace

std::uint32_t runs_wanted(const StudyMethod& method, double level) {
  if (!method.random) return 3;
  return std::uint32_t(std::clamp(256 / effort(method, level), 2.0, 20.0));
}

PointSummary summarise(const StudyPoint& point) {
  PointSummary s;
  s.rmse = root(mean_band(of_runs(point, [](const StudyRun& r) { return r.mean_square_error; })));
  s.wall_seconds = lower_median(of_runs(point, [](const StudyRun& r) { return r.wall_seconds; }));
  s.device_seconds = lower_median(of_runs(point, [](const StudyRun& r) { return r.device_seconds; }));
  s.rays = lower_median(of_runs(point, [](const StudyRun& r) { return r.rays; }));
  s.covered = mean(of_runs(point, [](const StudyRun& r) { return r.covered; }));
  s.error_claimed = mean(of_runs(point, [](const StudyRun& r) { return r.error_claimed; }));
  s.mean_error = mean(of_runs(point, [](const StudyRun& r) { return r.mean_error; }));
  const double cost = s.rmse.value * s.rmse.value * s.wall_seconds;
  s.efficiency = cost > 0 ? 1 / cost : 0;
  return s;
}

Study::Study(std::vector<StudyMethod> methods, StudyReference reference, const Settings& settings)
    : methods_(std::move(methods)), reference_(std::move(reference)), settings_(settings) {
  for (const float v : reference_.variance)
    reference_variance_ += double(v) / double(reference_.variance.size());
  for (std::size_t m = 0; m < methods_.size(); ++m)
    for (const double level : methods_[m].levels) {
      points_.push_back({methods_[m].name, level, runs_wanted(methods_[m], level), {}, 0, 0});
      slots_.push_back({m, {}, {}, 0, 0});
    }
}

void Study::resume(const std::vector<StudyPoint>& before) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (const StudyPoint& old : before) {
      if (old.method != points_[i].method || old.level != points_[i].level) continue;
      points_[i].runs = old.runs;
      points_[i].bias_square = slots_[i].bias_before = old.bias_square;
      points_[i].pairs = slots_[i].pairs_before = old.pairs;
    }
}

double Study::progress() const {
  double made = 0, wanted = 0;
  for (const StudyPoint& point : points_) {
    made += double(std::min<std::size_t>(point.runs.size(), point.wanted));
    wanted += point.wanted;
  }
  return wanted > 0 ? made / wanted : 1;
}

std::size_t Study::methods_without_runs() const {
  std::vector<bool> has_run(methods_.size());
  for (std::size_t p = 0; p < points_.size(); ++p)
    if (!points_[p].runs.empty()) has_run[slots_[p].method] = true;
  return std::size_t(std::count(has_run.begin(), has_run.end(), false));
}

void Study::measure(std::size_t p) {
  StudyPoint& point = points_[p];
  Slot& slot = slots_[p];
  const StudyMethod& method = methods_[slot.method];
  StudyRun run;
  run.seed = settings_.seed + std::uint32_t(point.runs.size());
  const StudyPicture picture = method.render(point.level, run.seed);
  run.wall_seconds = picture.wall_seconds;
  run.device_seconds = picture.device_seconds;
  run.rays = double(picture.rays);

  const std::size_t n = reference_.image.size();
  slot.error_sum.resize(n);
  double square = 0, sum = 0, claimed = 0, covered = 0, seen = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = double(picture.image[i]) - double(reference_.image[i]);
    const double own = reference_.variance.empty() ? 0 : double(reference_.variance[i]);
    sum += error;
    square += error * error;
    slot.error_sum[i] += error;
    if (picture.variance.empty() || reference_.image[i] == 0)
      continue;  // the background says nothing about intervals
    seen += 1;
    claimed += double(picture.variance[i]);
    covered += error * error <= z95 * z95 * (double(picture.variance[i]) + own);
  }
  slot.mean_squares.push_back(square / double(n));
  run.mean_square_error = square / double(n) - reference_variance_;
  run.mean_error = sum / double(n);
  if (seen > 0) {
    run.covered = covered / seen;
    run.error_claimed = std::sqrt(claimed / seen);
  }
  point.runs.push_back(run);
  if (!method.random) {
    point.bias_square = run.mean_square_error;
    return;
  }
  const double runs = double(slot.mean_squares.size()), pairs = 0.5 * runs * (runs - 1);
  if (pairs > 0) {
    const double bias = cross_moment(slot.error_sum, slot.mean_squares) - reference_variance_;
    point.pairs = slot.pairs_before + pairs;
    point.bias_square = (slot.bias_before * slot.pairs_before + bias * pairs) / point.pairs;
  }
}

double Study::expected_seconds(std::size_t p) const {
  if (!points_[p].runs.empty()) return points_[p].runs.back().wall_seconds;
  const StudyMethod& method = methods_[slots_[p].method];
  for (std::size_t q = p; q-- > 0 && slots_[q].method == slots_[p].method;)
    if (!points_[q].runs.empty())
      return points_[q].runs.back().wall_seconds * effort(method, points_[p].level) /
             effort(method, points_[q].level);
  // Nothing is known of the method yet: its cheapest level comes first.
  return p > 0 && slots_[p - 1].method == slots_[p].method ? std::numeric_limits<double>::infinity() : 0;
}

// The next run is of the point that will have had the least time after it. So cheap points have all their
// runs before dear ones have their second, and points of like cost take turns.
bool Study::run(const std::function<bool(const Study&)>& go_on) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::vector<double> spent(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p)
    for (const StudyRun& run : points_[p].runs) spent[p] += run.wall_seconds;
  for (;;) {
    const double left = settings_.seconds - std::chrono::duration<double>(Clock::now() - start).count();
    if (left <= 0) return true;
    std::size_t next = points_.size();
    double least = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      if (points_[p].finished()) continue;
      const double expected = expected_seconds(p), after = spent[p] + expected;
      if (expected > left || (next < points_.size() && after >= least)) continue;
      next = p;
      least = after;
    }
    if (next == points_.size()) return true;
    measure(next);
    spent[next] += points_[next].runs.back().wall_seconds;
    if (!go_on(*this)) return false;
  }
}

}  // namespace nook
