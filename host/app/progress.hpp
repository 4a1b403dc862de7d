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
  /// The total is only an estimate where a stop rule decides.
  void set_total(std::uint64_t total_samples) { total_ = total_samples ? total_samples : 1; }
  /// Words shown with the next lines ("error 0.012, 34 % of the pixels done").
  void set_note(const std::string& note) { note_ = note; }
  /// Ends a bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  ProgressMode mode_;
  bool terminal_;
  std::uint64_t total_;
  Clock::time_point start_, last_;
  std::string note_;
  bool drawn_ = false;
};

}  // namespace nook
