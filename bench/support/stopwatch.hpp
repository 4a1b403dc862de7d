#pragma once

#include <time.h>

namespace nook::bench {

/// Seconds since construction: of the wall clock, or of all this process's threads together, which a busy
/// machine disturbs less.
class Stopwatch {
 public:
  Stopwatch() : start_(now()) {}
  double seconds() const { return now() - start_; }

  /// Chosen once, before the first measurement.
  static inline bool cpu_time = false;

 private:
  static double now() {
    timespec t;
    clock_gettime(cpu_time ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }

  double start_;
};

}  // namespace nook::bench
