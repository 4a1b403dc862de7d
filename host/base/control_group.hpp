#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>

namespace nook {

inline constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// What the control groups of this process (a container's, a batch job's, a systemd slice's) allow: the least
/// of its own group's limit and those of the groups above it, of version 2 or 1. What is not limited, or
/// cannot be read, is unlimited.
class ControlGroups {
 public:
  /// `mounted`: where the groups' files are; `own`: the file that says which group this process is in.
  explicit ControlGroups(std::filesystem::path mounted = "/sys/fs/cgroup",
                         std::filesystem::path own = "/proc/self/cgroup")
      : mounted_(std::move(mounted)), own_(std::move(own)) {}

  /// Bytes that the limit leaves.
  std::uint64_t memory() const;
  /// Processors' worth of time a second (quota over period, e.g. 1.5); infinity without a quota.
  double processors() const;

 private:
  std::filesystem::path mounted_, own_;
};

}  // namespace nook
