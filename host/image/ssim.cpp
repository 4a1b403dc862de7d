#include "image/ssim.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nook {

namespace {

constexpr int window = 11;
constexpr double sigma = 1.5;
constexpr double c1 = 0.01 * 0.01;  // (K1 L)²
constexpr double c2 = 0.03 * 0.03;  // (K2 L)²

std::array<double, window> gaussian() {
  std::array<double, window> weight{};
  double sum = 0;
  for (int i = 0; i < window; ++i) {
    const double d = i - window / 2;
    sum += weight[i] = std::exp(-d * d / (2 * sigma * sigma));
  }
  for (double& w : weight) w /= sum;
  return weight;
}

/// Weighted sums of a, b, a², b² and ab: E[.] under the window's weights.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double w, double x, double y) {
    a += w * x;
    b += w * y;
    aa += w * x * x;
    bb += w * y * y;
    ab += w * x * y;
  }
  void add(double w, const Moments& m) {
    a += w * m.a;
    b += w * m.b;
    aa += w * m.aa;
    bb += w * m.bb;
    ab += w * m.ab;
  }
  double similarity() const {
    const double variance_a = aa - a * a, variance_b = bb - b * b, covariance = ab - a * b;
    return (2 * a * b + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variance_a + variance_b + c2));
  }
};

}  // namespace

double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height) {
  const std::array<double, window> weight = gaussian();
  const auto stride = static_cast<std::size_t>(width);
  std::vector<Moments> columns(stride);
  double sum = 0;
  std::uint64_t windows = 0;
  for (int y = 0; y + window <= height; ++y) {
    for (std::size_t x = 0; x < stride; ++x) {
      Moments m;
      for (int i = 0; i < window; ++i) {
        const std::size_t pixel = (static_cast<std::size_t>(y) + i) * stride + x;
        m.add(weight[i], a[pixel], b[pixel]);
      }
      columns[x] = m;
    }
    for (int x = 0; x + window <= width; ++x) {
      Moments m;
      for (int i = 0; i < window; ++i) m.add(weight[i], columns[static_cast<std::size_t>(x) + i]);
      const double similarity = m.similarity();
      if (!std::isfinite(similarity)) continue;  // a value that is not finite stays so through the sums
      sum += similarity;
      ++windows;
    }
  }
  return windows ? sum / static_cast<double>(windows) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace nook
