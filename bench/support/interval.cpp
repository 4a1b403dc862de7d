#include "bench/support/interval.hpp"

#include <algorithm>
#include <random>

#include "bench/support/record.hpp"

namespace nook::bench {

std::pair<double, double> interval_of_median(const std::vector<double>& values) {
  constexpr std::size_t resamples = 4000;
  std::mt19937 random(1979);
  std::uniform_int_distribution<std::size_t> one(0, values.size() - 1);
  std::vector<double> medians, resample(values.size());
  for (std::size_t i = 0; i < resamples; ++i) {
    for (double& value : resample) value = values[one(random)];
    medians.push_back(median(resample));
  }
  std::sort(medians.begin(), medians.end());
  return {medians[resamples / 40], medians[resamples - 1 - resamples / 40]};
}

}  // namespace nook::bench
