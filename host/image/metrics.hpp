#pragma once

#include <cstdint>
#include <span>

namespace nook {

/// Differences between an image a and a reference b, over the pixels where both are finite.
struct Metrics {
  std::uint64_t pixels = 0;      ///< compared
  std::uint64_t non_finite = 0;  ///< left out
  double rmse = 0;               ///< sqrt(mean((a-b)²))
  double rmse_without_reference_noise =
      0;           ///< sqrt(max(0, mean((a-b)²) - mean variance of b)); = rmse if none is given
  double mae = 0;  ///< mean |a-b|
  double max_abs = 0;
  double rel_mse = 0;          ///< mean((a-b)² / (b² + 0.01)), Rousselle et al. 2011
  double psnr = 0;             ///< dB for a peak of 1; infinity when equal
  double ssim = 0;             ///< Wang et al. 2004, 11x11 Gaussian, sigma 1.5, L = 1
  double mean_difference = 0;  ///< mean(a) - mean(b)
  double z_score = 0;          ///< mean_difference over its standard error (paired differences)
};

/// a, b: width * height values, row-major. reference_variance: empty, or the variance of each pixel of b.
Metrics compare_images(std::span<const float> a, std::span<const float> b, int width, int height,
                       std::span<const float> reference_variance = {});

}  // namespace nook
