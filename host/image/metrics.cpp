#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/ssim.hpp"

namespace nook {

Metrics compare_images(std::span<const float> a, std::span<const float> b, int width, int height,
                       std::span<const float> reference_variance) {
  Metrics m;
  const auto counts = [&](std::size_t i) {
    return std::isfinite(a[i]) && std::isfinite(b[i]) &&
           (reference_variance.empty() || std::isfinite(reference_variance[i]));
  };

  double sum = 0, sum_abs = 0, sum_square = 0, sum_relative = 0, sum_variance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!counts(i)) {
      ++m.non_finite;
      continue;
    }
    const double difference = double{a[i]} - b[i], square = difference * difference;
    ++m.pixels;
    sum += difference;
    sum_abs += std::abs(difference);
    sum_square += square;
    sum_relative += square / (double{b[i]} * b[i] + 0.01);
    m.max_abs = std::max(m.max_abs, std::abs(difference));
    if (!reference_variance.empty()) sum_variance += reference_variance[i];
  }
  if (m.pixels == 0) {
    const double undefined = std::numeric_limits<double>::quiet_NaN();
    m.rmse = m.rmse_without_reference_noise = m.mae = m.max_abs = m.rel_mse = m.psnr = m.ssim = undefined;
    m.mean_difference = m.z_score = undefined;
    return m;
  }

  const double n = static_cast<double>(m.pixels), mse = sum_square / n;
  m.rmse = std::sqrt(mse);
  m.rmse_without_reference_noise = std::sqrt(std::max(0.0, mse - sum_variance / n));
  m.mae = sum_abs / n;
  m.rel_mse = sum_relative / n;
  m.psnr = -10 * std::log10(mse);  // +infinity when equal
  m.ssim = structural_similarity(a, b, width, height);
  m.mean_difference = sum / n;

  // A second pass: n Σd² - (Σd)² would cancel when the images differ by nearly a constant.
  double scatter = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (counts(i)) scatter += std::pow(double{a[i]} - b[i] - m.mean_difference, 2);
  const double standard_error = std::sqrt(scatter / std::max(n - 1, 1.0) / n);
  m.z_score = m.mean_difference == 0 ? 0 : m.mean_difference / standard_error;
  return m;
}

}  // namespace nook
