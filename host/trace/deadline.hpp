#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace nook {

/// A moment to be finished by: when to stop for it, given that at the end of each launch another is already
/// under way, and how large launches may be so that one of them does not overrun it.
class Deadline {
 public:
  /// Seconds since any fixed moment.
  using Clock = std::function<double()>;

  /// Never, if `end` is unset; otherwise when `clock` says so.
  explicit Deadline(std::optional<double> end = {}, Clock clock = steady_seconds)
      : clock_(std::move(clock)), end_(end), last_(clock_()) {}

  /// Call it after each launch. rays: all that this process has traced. True when to stop now ends nearer to
  /// the moment than to go on; true from then on.
  bool reached(std::uint64_t rays);
  /// Rays of the next launch, at most: what takes an eighth of the time left, and a tenth of a second at
  /// most. `most` without a deadline.
  std::uint64_t launch_rays(std::uint64_t most) const;

  /// The steady clock.
  static double steady_seconds();

 private:
  Clock clock_;
  std::optional<double> end_;
  double last_ = 0;
  std::uint64_t rays_ = 0;
  int launches_ = 0;
  double launch_seconds_ = 0, rays_per_second_ = 0;  // of the last launch; 0 while unknown
  bool reached_ = false;
};

}  // namespace nook
