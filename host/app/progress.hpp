#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace nook {

enum class ProgressMode { automatic, plain, json, none };

/// "auto" (a bar on a terminal, plain lines otherwise), "plain", "json" or "none". Throws Error(usage).
ProgressMode parse_progress(const std::string& text);

/// Progress of a render, to stderr; stdout stays free for data.
class ProgressReporter {
 public:
  ProgressReporter(ProgressMode mode, std::uint64_t total_samples);
  /// Shows at most ten lines a second on a terminal, one in two seconds otherwise.
  void update(std::uint64_t samples, std::uint64_t rays);
  /// Ends a bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  ProgressMode mode_;
  bool terminal_;
  std::uint64_t total_;
  Clock::time_point start_, last_;
  bool drawn_ = false;
};

}  // namespace nook
