#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "adaptive/quantiles.hpp"

namespace nook {

/// A confidence interval; both ends are values of the estimate.
struct Interval {
  double low = 0, high = 0;
  double half_width() const { return 0.5 * (high - low); }
  bool contains(double value) const { return low <= value && value <= high; }
};

/// Σ x, Σ x² and the count of independent samples x >= 0.
struct SampleSums {
  double sum = 0, sum_square = 0, count = 0;
  double mean() const { return count > 0 ? sum / count : 0.0; }
};

/// The score interval of a mean: Wilson's (1927) for the samples' own variance function. With c = E[x²]/E[x],
///   Var x = E[x²] - μ² = μ (c - μ),
/// so x/c has the variance of a Bernoulli variable, and (x̄ - μ)² = z² μ (c - μ) / n is a quadratic in μ. For
/// samples 0 and 1 c = 1, Wilson's interval to the bit; otherwise c is estimated by Σx²/Σx, or by `bound`
/// (the largest x) if Σx = 0. It has a width even where all samples are equal, which a plain standard error
/// has not.
Interval score_interval(const SampleSums& sums, double bound, double z);

/// Samples after which score_interval() has a half width of at most z * error, for samples of that mean and
/// mean square.
double samples_needed(double mean, double mean_square, double bound, double error, double z);

/// When to stop, and what was asked.
struct ErrorTarget {
  double error =
      0.01;  ///< standard error of a pixel's estimate; the interval's half width is at most z times this
  double confidence = 0.95;    ///< of the intervals, in (0, 1)
  std::uint32_t min_spp = 16;  ///< camera samples a pixel
  std::uint32_t max_spp = 65536;

  double z() const { return normal_quantile(confidence); }
};

/// The numbers of samples after which pixels are looked at: `first`, then an eighth more each time, in
/// multiples of 16, up to `last` (included).
std::vector<std::uint32_t> stages_from(std::uint32_t first, std::uint32_t last);

/// Sequential estimation of a probability from k hits in n samples of 0 or 1: stop at the first stage at
/// which the estimate's interval is narrow enough.
///
/// Wilson's interval is not symmetric about the estimate. At a value of .03 and an error of .0075, estimate ±
/// its half width holds the value in 91 % of the runs, and the estimate's standard error is 1.13 times the
/// one asked for. So the half width is never less than z sqrt(p (1 - p) / n) with p = (k + 2.5) / (n + 5),
/// with which both are right (exact shares: tests/unit/stop_rule_test.cpp).
///
/// k/n at the stopping time is biased (by -44 % at p = .05 with a rule that stops on few hits). The unbiased
/// estimate is that of Girshick, Mosteller and Savage 1946 ("Unbiased estimates for certain binomial sampling
/// problems with applications"): of all equally likely orders of the samples that reach (n, k) without having
/// stopped before, the share that starts with a hit. By Rao-Blackwell that is E[k₁/n₁ | n, k] with k₁ the
/// hits at the first stage; it depends on the rule alone, not on p.
class CountRule {
 public:
  explicit CountRule(const ErrorTarget& target);

  /// The numbers of samples at which pixels are looked at.
  const std::vector<std::uint32_t>& stages() const { return stages_; }
  /// Whether a pixel with k hits in n samples is accurate enough.
  bool done(std::uint32_t n, std::uint32_t k) const;
  /// The unbiased estimate for a pixel that was stopped at (n, k): by the rule, or at any n from outside
  /// (time, the largest spp), for reasons that do not depend on its samples. k/n for n below the first stage.
  double estimate(std::uint32_t n, std::uint32_t k) const;
  /// Wilson's.
  Interval interval(std::uint32_t n, std::uint32_t k) const;
  /// The estimate is within this of the value as often as the target's confidence says.
  double half_width(std::uint32_t n, std::uint32_t k) const;

 private:
  // Of the orders of k hits in n samples: the share that goes on to n, and the sum of k₁/n₁ over these.
  struct Paths {
    double share = 0, first = 0;
  };
  Paths extend(std::size_t from, std::uint32_t n, std::uint32_t k) const;

  ErrorTarget target_;
  double z_;
  std::vector<std::uint32_t> stages_;
  // going_on_[j]: the first k and then the paths of each k with which a pixel goes on after stage j; an
  // interval of k, since the interval is widest in the middle.
  struct GoingOn {
    std::uint32_t first_k = 0;
    std::vector<Paths> paths;
  };
  std::vector<GoingOn> going_on_;
};

}  // namespace nook
