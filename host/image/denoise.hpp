#pragma once

#include <span>
#include <vector>

namespace nook {

/// What guides a denoiser: the surface under each pixel's centre. Planes of width * height floats, row-major.
struct DenoiseGuides {
  int width = 0, height = 0;
  std::span<const float>
      normal[3];  ///< unit; 0, 0, 0 where there is no surface: such a pixel stays as it is, and gives nothing
  std::span<const float> position[3];  ///< world units
};

/// How much a difference counts. The defaults are those that the tests and the study measure.
struct DenoiseSettings {
  int passes = 5;                ///< taps reach 2 (2^passes - 1) pixels
  float normal_power = 64;       ///< weight (N_p . N_q)^power
  float plane_tolerance = 0.1f;  ///< weight e^(-sin / tolerance), sin = |N_p . (X_q - X_p)| / |X_q - X_p|
  float deviations = 4;          ///< weight e^(-|c_q - c_p| / (deviations * standard error of c_p))
  unsigned threads = 0;          ///< 0: all; the result does not depend on it
};

/// The edge-avoiding à-trous filter of Dammertz, Sewtz, Hanika, Lensch, "Edge-Avoiding À-Trous Wavelet
/// Transform for fast Global Illumination Filtering" (HPG 2010), steered by variance as in Schied et al.,
/// "Spatiotemporal Variance-Guided Filtering" (HPG 2017), section 4.4: pass i takes 5 x 5 taps 2^i pixels
/// apart with the B3 spline's weights times the three above, and filters the variance of the estimates with
/// the squares of the weights. The standard error of a pixel is taken over its 3 x 3 neighbours of one
/// surface, since a variance measured from few samples is itself noise.
///
/// values, variance: planes of the estimate and of its variance (at least 0). The filter is biased: it trades
/// noise for blur where the guides see no edge (docs/effects.md has both). It is deterministic, a constant
/// picture stays as it is to the bit, and no value leaves the range of the values given.
std::vector<float> denoise(const DenoiseGuides& guides, std::span<const float> values,
                           std::span<const float> variance, const DenoiseSettings& settings = {});

}  // namespace nook
