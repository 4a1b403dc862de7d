#include "report/study_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace nook {
Band mean_band(std::span<const double> values, double confidence) {
  if (values.empty()) return {};
  const double n = double(values.size());
  double sum = 0, square = 0;
  for (const double v : values) sum += v;
  const double mean = sum / n;
  if (values.size() < 2) return {mean, mean, mean};
  for (const double v : values) square += (v - mean) * (v - mean);
  const double half_width =
      student_quantile(confidence, unsigned(values.size() - 1)) * std::sqrt(square / (n - 1) / n);
  return {mean, mean - half_width, mean + half_width};
}

Band root(const Band& b) {
  return {std::sqrt(std::max(0.0, b.value)), std::sqrt(std::max(0.0, b.low)),
          std::sqrt(std::max(0.0, b.high))};
}

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y,
                                std::span<const double> weights) {
  if (x.size() < 3) return std::nullopt;
  double w = 0, mx = 0, my = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    w += weights[i];
    mx += weights[i] * x[i];
    my += weights[i] * y[i];
  }
  mx /= w;
  my /= w;
  double sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sxx += weights[i] * (x[i] - mx) * (x[i] - mx);
    sxy += weights[i] * (x[i] - mx) * (y[i] - my);
  }
  if (!(sxx > 0)) return std::nullopt;
  LineFit fit;
  fit.slope = sxy / sxx;
  fit.intercept = my - fit.slope * mx;
  double residual = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    residual += weights[i] * std::pow(y[i] - fit.intercept - fit.slope * x[i], 2);
  fit.slope_error = std::sqrt(residual / double(x.size() - 2) / sxx);
  return fit;
}

std::optional<Cost> cost_of_error(std::span<const CostPoint> curve, double error) {
  std::vector<double> x, y;
  const CostPoint* before = nullptr;
  for (const CostPoint& point : curve) {
    if (!(point.cost > 0) || !(point.error > 0)) continue;
    if (point.error <= error) {
      if (!before) return Cost{point.cost, false};
      const double along = std::log(before->error / error) / std::log(before->error / point.error);
      return Cost{before->cost * std::pow(point.cost / before->cost, along), false};
    }
    before = &point;
    x.push_back(std::log(point.cost));
    y.push_back(std::log(point.error));
  }
  const auto fit = fit_line(x, y, std::vector<double>(x.size(), 1.0));
  if (!fit || fit->slope > -0.1) return std::nullopt;
  const double cost = before->cost * std::pow(error / before->error, 1 / fit->slope);
  if (cost > 4 * before->cost) return std::nullopt;
  return Cost{cost, true};
}

double cross_moment(std::span<const double> sum_of_errors, std::span<const double> mean_squares) {
  const double n = double(mean_squares.size());
  if (n < 2 || sum_of_errors.empty()) return 0;
  double of_sum = 0, own = 0;
  for (const double s : sum_of_errors) of_sum += s * s;
  for (const double m : mean_squares) own += m;
  return (of_sum / double(sum_of_errors.size()) - own) / (n * (n - 1));
}

}  // namespace nook
