#pragma once

#include "base/stopwatch.hpp"

namespace nook::bench {

/// What the benches measure: --cpu-time chooses, before the first measurement.
inline Stopwatch::Of measured = Stopwatch::Of::wall;

inline Stopwatch started() {
  return Stopwatch(measured);
}

}  // namespace nook::bench
