#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::test {

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0. Series and continued fraction
/// (Abramowitz and Stegun 6.5.29, 6.5.31).
double gamma_q(double a, double x);

/// Regularised incomplete beta function I_x(a, b), 0 <= x <= 1, a, b > 0. Continued fraction (DLMF 8.17.22).
double beta_i(double x, double a, double b);

/// Two-sided p-value of a standard normal deviate.
double normal_p(double z);

/// Two-sided p-value of Student's t with that many degrees of freedom.
double student_p(double t, double degrees);

/// P(X² >= statistic) for a chi-squared variable of that many degrees of freedom.
double chi2_p(double statistic, double degrees);

/// P-value of Pearson's test that `counts` come from cells of equal probability.
double uniform_counts_p(std::span<const std::uint64_t> counts);

/// P-value of the one-sample Kolmogorov-Smirnov test that values in [0,1] are uniform; asymptotic with
/// Stephens' 1970 small-sample factor. Sorts its argument.
double ks_uniform_p(std::vector<double>& values);

/// The significance each of `tests` independent tests needs, for the family to have `family_alpha` (Sidak
/// 1967).
double sidak(double family_alpha, std::size_t tests);

/// Sample moments, with the standard errors of the mean and of the variance (from the fourth central moment).
struct Moments {
  std::size_t count = 0;
  double mean = 0;
  double variance = 0;        ///< unbiased
  double mean_error = 0;      ///< one standard error
  double variance_error = 0;  ///< one standard error, 0 for a constant sample
};
Moments moments(std::span<const double> values);
Moments moments(std::span<const float> values);

/// z of two independent means (Welch 1947, for large samples); 0 if both are exact and equal, infinite if
/// they differ.
double welch_z(double mean_a, double error_a, double mean_b, double error_b);

/// Least-squares line y = intercept + slope x, and the slope's standard error.
struct Line {
  double intercept = 0, slope = 0, slope_error = 0;
};
Line fit_line(std::span<const double> x, std::span<const double> y);

/// True in the longer mode, NOOK_TEST_LONG=1: more samples and a fresh seed.
bool long_mode();

/// The seed of a statistical test: `fixed`, or in the long mode a fresh one, which is printed so that a
/// failure can be repeated by NOOK_TEST_SEED.
std::uint32_t test_seed(std::uint32_t fixed);

}  // namespace nook::test
