#include "trace/deadline.hpp"

#include <algorithm>
#include <chrono>

namespace nook {
namespace {

constexpr std::uint64_t least_launch = 1u << 14, first_launch = 1u << 16;
// The first launches also load code: they say nothing about the next.
constexpr int launches_to_ignore = 2;

}  // namespace

double Deadline::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Stopping now ends after the launch under way, going on at least one later: the middle decides.
bool Deadline::reached(std::uint64_t rays) {
  if (!end_) return false;
  const double now = clock_();
  if (++launches_ > launches_to_ignore) {
    launch_seconds_ = now - last_;
    if (launch_seconds_ > 0) rays_per_second_ = double(rays - rays_) / launch_seconds_;
  }
  last_ = now;
  rays_ = rays;
  return reached_ = reached_ || now + 1.5 * launch_seconds_ >= *end_;
}

std::uint64_t Deadline::launch_rays(std::uint64_t most) const {
  if (!end_) return most;
  if (rays_per_second_ <= 0) return std::min(most, first_launch);
  const double seconds = std::clamp((*end_ - clock_()) / 8, 0.0, 0.1);
  return std::clamp(std::uint64_t(rays_per_second_ * seconds), std::min(most, least_launch), most);
}

}  // namespace nook
