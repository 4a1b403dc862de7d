#pragma once

#include <span>

#include "film/film.hpp"

namespace nook {

/// What a stop rule was asked for, and what it reached: standard errors of pixels.
struct ErrorRecord {
  double asked = 0;  ///< 0: no error was asked for, only a time
  double confidence = 0;
  double reached = 0;  ///< root mean square over the pixels that see the mesh
  double worst = 0;
  double share_done = 0;  ///< of the pixels
};

/// What a render that ended by time has reached, by the films' own variances.
ErrorRecord error_of(std::span<const Film> films);

}  // namespace nook
