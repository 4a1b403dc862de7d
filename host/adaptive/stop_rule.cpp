#include "adaptive/stop_rule.hpp"

#include <algorithm>
#include <cmath>

namespace nook {
namespace {

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

// P(i of the first m among n samples are hits | k of the n are).
double hypergeometric(double i, double n, double k, double m) {
  if (i < 0 || i > k || m - i < 0 || m - i > n - k) return 0;
  return std::exp(log_choose(m, i) + log_choose(n - m, k - i) - log_choose(n, k));
}

}  // namespace

Interval score_interval(const SampleSums& sums, double bound, double z) {
  const double n = sums.count, mean = sums.mean();
  if (!(n > 0)) return {0, bound};
  const double c = sums.sum > 0 ? std::max(sums.sum_square / sums.sum, mean) : bound;
  const double z2 = z * z / n;
  const double center = (mean + 0.5 * z2 * c) / (1 + z2);
  const double half = z / (1 + z2) * std::sqrt(mean * (c - mean) / n + 0.25 * z2 * c * c / n);
  return {std::max(0.0, center - half), center + half};
}

double samples_needed(double mean, double mean_square, double bound, double error, double z) {
  // The half width's square over z² is (v n + z² c²/4) / (n + z²)²: equal to error² for a root of a
  // quadratic.
  const double c = mean > 0 ? std::max(mean_square / mean, mean) : bound, v = mean * (c - mean);
  const double z2 = z * z, e2 = error * error, b = 0.5 * v - e2 * z2;
  const double root = b * b + e2 * z2 * (0.25 * c * c - e2 * z2);
  return root > 0 ? std::max(0.0, (b + std::sqrt(root)) / e2) : 0;
}

std::vector<std::uint32_t> stages_from(std::uint32_t first, std::uint32_t last) {
  std::vector<std::uint32_t> stages;
  for (std::uint64_t n = std::min(first, last); n < last; n += std::max<std::uint64_t>(16, n / 128 * 16))
    stages.push_back(std::uint32_t(n));
  stages.push_back(last);
  return stages;
}

CountRule::CountRule(const ErrorTarget& target)
    : target_(target), z_(target.z()), stages_(stages_from(target.min_spp, target.max_spp)) {
  for (std::size_t j = 0; j < stages_.size(); ++j) {
    const std::uint32_t n = stages_[j];
    GoingOn next;
    std::uint32_t end = n + 1;
    while (next.first_k < end && done(n, next.first_k)) ++next.first_k;
    while (end > next.first_k && done(n, end - 1)) --end;
    if (next.first_k == end) {
      stages_.resize(j + 1);  // every pixel stops here
      return;
    }
    if (j + 1 == stages_.size()) return;
    for (std::uint32_t k = next.first_k; k < end; ++k)
      next.paths.push_back(j == 0 ? Paths{1, double(k) / n} : extend(j - 1, n, k));
    going_on_.push_back(std::move(next));
  }
}

bool CountRule::done(std::uint32_t n, std::uint32_t k) const {
  return half_width(n, k) <= z_ * target_.error;
}

double CountRule::half_width(std::uint32_t n, std::uint32_t k) const {
  const double p = (k + 2.5) / (n + 5.0);
  return std::max(interval(n, k).half_width(), z_ * std::sqrt(p * (1 - p) / n));
}

Interval CountRule::interval(std::uint32_t n, std::uint32_t k) const {
  return score_interval({double(k), double(k), double(n)}, 1, z_);
}

CountRule::Paths CountRule::extend(std::size_t from, std::uint32_t n, std::uint32_t k) const {
  const GoingOn& before = going_on_[from];
  const double m = stages_[from];
  // The hits among the first m of n: mean and deviation of the hypergeometric distribution; the terms beyond
  // 9 deviations add less than rounding does.
  const double mean = k * (m / n);
  const double deviation =
      std::sqrt(std::max(0.0, mean * (1 - double(k) / n) * (n - m) / std::max(1.0, n - 1.0)));
  const double spread = 9 * deviation + 3;
  const double end = double(before.first_k) + double(before.paths.size()) - 1;
  const auto low = std::max({double(before.first_k), std::ceil(mean - spread), double(k) - (double(n) - m)});
  const auto high = std::min({end, std::floor(mean + spread), double(k), m});
  Paths sum;
  if (low > high) return sum;
  double weight = hypergeometric(low, n, k, m);
  for (double i = low; i <= high; ++i) {
    const Paths& path = before.paths[std::size_t(i) - before.first_k];
    sum.share += weight * path.share;
    sum.first += weight * path.first;
    weight *= (m - i) * (k - i) / ((i + 1) * (n - m - k + i + 1));
  }
  return sum;
}

double CountRule::estimate(std::uint32_t n, std::uint32_t k) const {
  const auto before = std::size_t(std::lower_bound(stages_.begin(), stages_.end(), n) - stages_.begin());
  if (before == 0) return n ? double(k) / n : 0.0;
  const Paths paths = extend(std::min(before - 1, going_on_.size() - 1), n, k);
  return paths.share > 0 ? paths.first / paths.share : double(k) / n;
}

}  // namespace nook
