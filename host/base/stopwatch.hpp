#pragma once

#include <time.h>

namespace nook {

/// Seconds of the wall clock, or of all this process's threads together, which a busy machine disturbs less.
class Stopwatch {
 public:
  enum class Of { wall, threads };

  Stopwatch() : Stopwatch(Of::wall) {}
  explicit Stopwatch(Of of) : of_(of), start_(now()) {}
  /// Since it was made, or since the last lap().
  double seconds() const { return now() - start_; }
  /// The same, and starts again.
  double lap() {
    const double end = now(), passed = end - start_;
    start_ = end;
    return passed;
  }

 private:
  double now() const {
    timespec t = {};
    clock_gettime(of_ == Of::wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }

  Of of_;
  double start_;
};

}  // namespace nook
