#include "render/quantiles.hpp"

#include <cmath>
#include <numbers>

namespace nook {
namespace {

// Density of Student's distribution.
double student_density(double t, double n) {
  return std::exp(std::lgamma(0.5 * (n + 1)) - std::lgamma(0.5 * n)) / std::sqrt(n * std::numbers::pi) *
         std::pow(1 + t * t / n, -0.5 * (n + 1));
}

// P(0 < T < t): Simpson's rule in x with t = x / (1 - x), whose integrand is smooth and bounded.
double student_half(double t, double n) {
  constexpr int steps = 2000;
  const double end = t / (1 + t), h = end / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double x = i * h, weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
    sum += weight * student_density(x / (1 - x), n) / ((1 - x) * (1 - x));
  }
  return sum * h / 3;
}

}  // namespace

double normal_quantile(double confidence) {
  // Newton on erfc, whose derivative is known; it starts at 0, where the function is steepest, and so never
  // overshoots.
  const double tail = 1 - confidence;
  double z = 0;
  for (int step = 0; step < 200; ++step) {
    const double density = 2 * std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi);
    const double change = (std::erfc(z / std::numbers::sqrt2) - tail) / density;
    z += change;
    if (std::abs(change) < 1e-14) break;
  }
  return z;
}

double student_quantile(double confidence, unsigned degrees) {
  double low = 0, high = 1e4;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (2 * student_half(middle, degrees) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace nook
