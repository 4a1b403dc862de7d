#include "adaptive/quantiles.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace nook {
namespace {

// Density of Student's distribution but for its constant.
double student_shape(double t, double n) {
  return std::pow(1 + t * t / n, -0.5 * (n + 1));
}

// Its integral from 0 to t: Simpson's rule in x with t = x / (1 - x), whose integrand is smooth and bounded.
double student_area(double t, double n) {
  constexpr int steps = 500;
  const double end = t / (1 + t), h = end / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double x = i * h, weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
    sum += weight * student_shape(x / (1 - x), n) / ((1 - x) * (1 - x));
  }
  return sum * h / 3;
}

double student_root(double confidence, unsigned degrees) {
  // Newton on the distribution, which is concave right of 0: it never overshoots.
  const double n = degrees, scale = 2 / std::sqrt(n * std::numbers::pi) *
                                    std::exp(std::lgamma(0.5 * (n + 1)) - std::lgamma(0.5 * n));
  double t = 0;
  for (int step = 0; step < 200; ++step) {
    const double change = (confidence - scale * student_area(t, n)) / (scale * student_shape(t, n));
    t += change;
    if (std::abs(change) < 1e-12 * (1 + t)) break;
  }
  return t;
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

// It takes some 30 microseconds and is asked for each point, of few degrees.
double student_quantile(double confidence, unsigned degrees) {
  thread_local std::map<std::pair<double, unsigned>, double> known;
  if (known.size() > 1000) known.clear();
  const auto [place, fresh] = known.try_emplace({confidence, degrees});
  if (fresh) place->second = student_root(confidence, degrees);
  return place->second;
}

}  // namespace nook
