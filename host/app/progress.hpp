#pragma once

#include <chrono>
#include <string>

#include "render/observer.hpp"

namespace nook {

enum class ProgressMode { automatic, plain, json, none };

/// "auto" (a bar on a terminal, plain lines otherwise), "plain", "json" or "none". Throws Error(usage).
ProgressMode parse_progress(const std::string& text);

/// Progress of a render, to stderr (stdout stays free for data); a signal cancels it (app/interrupt.hpp).
class TerminalObserver : public RunObserver {
 public:
  explicit TerminalObserver(ProgressMode mode);
  /// Shows at most ten lines a second on a terminal, one in two seconds otherwise.
  void progress(const RunProgress& now) override;
  bool cancelled() override;
  void warn(const std::string& what) override;
  /// Ends a bar's line.
  void end() override;

 private:
  using Clock = std::chrono::steady_clock;
  ProgressMode mode_;
  bool terminal_;
  Clock::time_point start_, last_;
  bool drawn_ = false;
};

}  // namespace nook
