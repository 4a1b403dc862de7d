#include "adaptive/error_record.hpp"

#include <algorithm>
#include <cmath>

namespace nook {

ErrorRecord error_of(std::span<const Film> films) {
  ErrorRecord error;
  double square = 0, seen = 0;
  for (const Film& film : films)
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (film.hits[i] == 0) continue;
      const double variance = film.variance(i);
      square += variance;
      seen += 1;
      error.worst = std::max(error.worst, std::sqrt(variance));
    }
  error.reached = seen > 0 ? std::sqrt(square / seen) : 0;
  error.share_done = 1;
  return error;
}

}  // namespace nook
