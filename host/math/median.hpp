#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nook {

/// The lower and the upper of the two middle values (the middle one of an odd number, 0 of none). Of two
/// times the lower is the one that was disturbed less.
inline double lower_median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
inline double upper_median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The mean of the two.
inline double median(const std::vector<double>& values) {
  return 0.5 * (lower_median(values) + upper_median(values));
}

}  // namespace nook
