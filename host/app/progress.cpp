#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "app/interrupt.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"

namespace nook {

ProgressMode parse_progress(const std::string& text) {
  if (text == "auto") return ProgressMode::automatic;
  if (text == "plain") return ProgressMode::plain;
  if (text == "json") return ProgressMode::json;
  if (text == "none") return ProgressMode::none;
  throw Error(ErrorKind::usage,
              fmt::format("--progress: unknown value '{}', known: auto, plain, json, none", text));
}

TerminalObserver::TerminalObserver(ProgressMode mode)
    : mode_(mode),
      terminal_(mode == ProgressMode::automatic && isatty(STDERR_FILENO)),
      start_(Clock::now()),
      last_(start_) {}

void TerminalObserver::progress(const RunProgress& run) {
  if (mode_ == ProgressMode::none) return;
  const Clock::time_point now = Clock::now();
  const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(2000);
  if (now - last_ < interval) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double share = double(run.samples) / double(run.total);
  const double left = share > 0 ? seconds * (1 - share) / share : 0;
  const double rate = double(run.rays) / seconds * 1e-6;
  const std::string note = run.error > 0 ? fmt::format("error {:.4f}, {:.0f} % of the pixels done", run.error,
                                                       100 * run.share_done)
                                         : "";
  if (mode_ == ProgressMode::json) {
    to_stderr("{{\"progress\": {:.4f}, \"seconds\": {:.2f}, \"seconds_left\": {:.2f}, \"rays\": {}{}}}\n",
              share, seconds, left, run.rays, note.empty() ? "" : fmt::format(", \"note\": \"{}\"", note));
  } else if (terminal_) {
    constexpr int cells = 30;
    const int filled = std::clamp(int(share * cells), 0, cells);
    to_stderr("\r[{}{}] {:3.0f} %  {:.1f} Mrays/s  {:.0f} s left {} ", std::string(std::size_t(filled), '#'),
              std::string(std::size_t(cells - filled), '.'), 100 * share, rate, left, note);
    drawn_ = true;
  } else {
    to_stderr("{:.0f} %  {:.1f} Mrays/s  {:.0f} s left{}{}\n", 100 * share, rate, left,
              note.empty() ? "" : "  ", note);
  }
  std::fflush(stderr);
}

bool TerminalObserver::cancelled() {
  return interrupted();
}

void TerminalObserver::warn(const std::string& what) {
  to_stderr("warning: {}\n", what);
}

void TerminalObserver::end() {
  if (drawn_) to_stderr("\r{:<110}\r", "");
  drawn_ = false;
}

}  // namespace nook
