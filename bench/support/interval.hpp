#pragma once

#include <utility>
#include <vector>

namespace nook::bench {

/// The 95 % interval of the median by the bootstrap (Efron 1979, percentiles of 4000 resamples of a fixed
/// seed): where the median of endlessly many rounds may lie, judged by these.
std::pair<double, double> interval_of_median(const std::vector<double>& values);

}  // namespace nook::bench
