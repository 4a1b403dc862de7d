#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/error.hpp"

namespace nook {

ProgressMode parse_progress(const std::string& text) {
  if (text == "auto") return ProgressMode::automatic;
  if (text == "plain") return ProgressMode::plain;
  if (text == "json") return ProgressMode::json;
  if (text == "none") return ProgressMode::none;
  throw Error(ExitCode::usage,
              fmt::format("--progress: unknown value '{}', known: auto, plain, json, none", text));
}

ProgressReporter::ProgressReporter(ProgressMode mode, std::uint64_t total_samples)
    : mode_(mode),
      terminal_(mode == ProgressMode::automatic && isatty(STDERR_FILENO)),
      total_(std::max<std::uint64_t>(total_samples, 1)),
      start_(Clock::now()),
      last_(start_) {}

void ProgressReporter::update(std::uint64_t samples, std::uint64_t rays) {
  if (mode_ == ProgressMode::none) return;
  const Clock::time_point now = Clock::now();
  const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(2000);
  if (now - last_ < interval) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double share = double(samples) / double(total_);
  const double left = share > 0 ? seconds * (1 - share) / share : 0;
  const double rate = double(rays) / seconds * 1e-6;
  if (mode_ == ProgressMode::json) {
    fmt::print(stderr,
               "{{\"progress\": {:.4f}, \"seconds\": {:.2f}, \"seconds_left\": {:.2f}, \"rays\": {}{}}}\n",
               share, seconds, left, rays, note_.empty() ? "" : fmt::format(", \"note\": \"{}\"", note_));
  } else if (terminal_) {
    constexpr int cells = 30;
    const int filled = std::clamp(int(share * cells), 0, cells);
    fmt::print(stderr, "\r[{}{}] {:3.0f} %  {:.1f} Mrays/s  {:.0f} s left {} ",
               std::string(std::size_t(filled), '#'), std::string(std::size_t(cells - filled), '.'),
               100 * share, rate, left, note_);
    drawn_ = true;
  } else {
    fmt::print(stderr, "{:.0f} %  {:.1f} Mrays/s  {:.0f} s left{}{}\n", 100 * share, rate, left,
               note_.empty() ? "" : "  ", note_);
  }
  std::fflush(stderr);
}

void ProgressReporter::finish() {
  if (drawn_) fmt::print(stderr, "\r{:<110}\r", "");
  drawn_ = false;
}

}  // namespace nook
