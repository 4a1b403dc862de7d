#include "support/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

namespace nook::test {
namespace {

constexpr double tiny = 1e-300;
constexpr double precision = 1e-15;

// Modified Lentz evaluation of b0 + a1/(b1 + a2/(b2 + ...)) (Thompson and Barnett 1986).
template <class A, class B>
double continued_fraction(double b0, A&& a, B&& b) {
  double f = b0 == 0 ? tiny : b0, c = f, d = 0;
  for (int k = 1; k < 100000; ++k) {
    d = b(k) + a(k) * d;
    c = b(k) + a(k) / c;
    if (d == 0) d = tiny;
    if (c == 0) c = tiny;
    d = 1 / d;
    f *= c * d;
    if (std::abs(c * d - 1) < precision) break;
  }
  return f;
}

}  // namespace

double gamma_q(double a, double x) {
  if (x <= 0) return 1;
  double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < 100000 && term > precision * sum; ++k) sum += term *= x / (a + k);
    return 1 - front * sum;
  }
  return front /
         continued_fraction(
             x + 1 - a, [a](int k) { return k * (a - k); }, [a, x](int k) { return x + 2 * k + 1 - a; });
}

double beta_i(double x, double a, double b) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - beta_i(1 - x, b, a);
  double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) /
      a;
  auto coefficient = [=](int j) {
    int m = j / 2;
    return j % 2 ? -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
                 : m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
  };
  return front / continued_fraction(1, coefficient, [](int) { return 1.0; });
}

double normal_p(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double student_p(double t, double degrees) {
  return beta_i(degrees / (degrees + t * t), degrees / 2, 0.5);
}

double chi2_p(double statistic, double degrees) {
  return gamma_q(degrees / 2, statistic / 2);
}

double uniform_counts_p(std::span<const std::uint64_t> counts) {
  double total = 0;
  for (std::uint64_t count : counts) total += double(count);
  double expected = total / double(counts.size()), statistic = 0;
  for (std::uint64_t count : counts)
    statistic += (double(count) - expected) * (double(count) - expected) / expected;
  return chi2_p(statistic, double(counts.size()) - 1);
}

double ks_uniform_p(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  double n = double(values.size()), d = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    d = std::max({d, values[i] - double(i) / n, double(i + 1) / n - values[i]});
  double lambda = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * d;
  if (lambda < 0.2) return 1;
  double p = 0;
  for (int k = 1; k <= 100; ++k) p += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * lambda * lambda);
  return std::clamp(p, 0.0, 1.0);
}

double sidak(double family_alpha, std::size_t tests) {
  return -std::expm1(std::log1p(-family_alpha) / double(tests));
}

template <class T>
static Moments moments_of(std::span<const T> values) {
  Moments m;
  m.count = values.size();
  double n = double(values.size()), sum = 0, second = 0, fourth = 0;
  for (T v : values) sum += v;
  m.mean = sum / n;
  for (T v : values) {
    double square = (v - m.mean) * (v - m.mean);
    second += square;
    fourth += square * square;
  }
  m.variance = second / (n - 1);
  m.mean_error = std::sqrt(m.variance / n);
  double biased = second / n;
  m.variance_error = std::sqrt(std::max(0.0, (fourth / n - biased * biased) / n));
  return m;
}

Moments moments(std::span<const double> values) {
  return moments_of(values);
}
Moments moments(std::span<const float> values) {
  return moments_of(values);
}

double welch_z(double mean_a, double error_a, double mean_b, double error_b) {
  double difference = mean_a - mean_b, error = std::hypot(error_a, error_b);
  if (error > 0) return difference / error;
  return difference == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
  double n = double(x.size()), mean_x = 0, mean_y = 0, sxx = 0, sxy = 0, rest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += (x[i] - mean_x) * (x[i] - mean_x);
    sxy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  Line line;
  line.slope = sxy / sxx;
  line.intercept = mean_y - line.slope * mean_x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double residual = y[i] - line.intercept - line.slope * x[i];
    rest += residual * residual;
  }
  line.slope_error = n > 2 ? std::sqrt(rest / (n - 2) / sxx) : 0;
  return line;
}

bool long_mode() {
  const char* value = std::getenv("NOOK_TEST_LONG");
  return value && value[0] == '1';
}

std::uint32_t test_seed(std::uint32_t fixed) {
  if (const char* given = std::getenv("NOOK_TEST_SEED"))
    return std::uint32_t(std::strtoul(given, nullptr, 0));
  if (!long_mode()) return fixed;
  static const std::uint32_t fresh = [] {
    std::uint32_t seed = std::random_device{}();
    std::printf("NOOK_TEST_SEED=%u\n", seed);
    return seed;
  }();
  return fresh;
}

}  // namespace nook::test
