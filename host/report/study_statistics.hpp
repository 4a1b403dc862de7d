#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adaptive/quantiles.hpp"

namespace nook {

/// A value and its confidence band.
struct Band {
  double value = 0, low = 0, high = 0;
};

/// The mean of independent values with its band by Student's distribution; of a single value, the band is
/// that value.
Band mean_band(std::span<const double> values, double confidence = 0.95);

/// The square root of a mean square error and of its band; negative values (a reference's variance was
/// subtracted) are 0.
Band root(const Band& mean_square);

/// y = intercept + slope x by least squares with weights, and the slope's standard error.
struct LineFit {
  double slope = 0, intercept = 0, slope_error = 0;
};
/// nullopt for fewer than three points.
std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y,
                                std::span<const double> weights);

/// A point of a curve of error against cost; both positive.
struct CostPoint {
  double cost = 0, error = 0;
};
struct Cost {
  double value = 0;
  bool extrapolated = false;  ///< beyond the dearest point, along the curve's slope
};
/// The cost at which a curve (cost ascending) falls to `error`: by log-log interpolation at the first point
/// that does, or else along the fitted slope, up to four times the dearest point's cost. nullopt if it would
/// take more, or the curve does not fall. If the cheapest point is accurate enough already, its cost.
std::optional<Cost> cost_of_error(std::span<const CostPoint> curve, double error);

/// The mean over pixels of E[e_a e_b] for different runs a, b: the squared bias (plus the reference's
/// variance), without the runs' own noise. sum_of_errors: Σ_runs e of each pixel; mean_squares: mean over
/// pixels of e² of each run. 0 for fewer than two runs.
double cross_moment(std::span<const double> sum_of_errors, std::span<const double> mean_squares);

}  // namespace nook
