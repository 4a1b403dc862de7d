#include "base/control_group.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace nook {
namespace {

namespace fs = std::filesystem;

// The first number in a file; unlimited if there is none ("max").
std::uint64_t number_in(const fs::path& file) {
  std::ifstream in(file);
  std::uint64_t value = 0;
  return in >> value ? value : unlimited;
}

// A group's folder and those above it, for a controller of version 1, or "" for version 2. Lines of `own` are
// "7:cpu,cpuacct:/docker/4f" and "0::/user.slice". A container may see its own group as the root, and be told
// the name that it has outside: the root counts in any case.
std::vector<fs::path> folders_of(const std::string& controller, const fs::path& mounted,
                                 const fs::path& own) {
  std::vector<fs::path> folders;
  std::ifstream in(own);
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string names = ',' + line.substr(first + 1, second - first - 1) + ',';
    if (controller.empty() ? names != ",," : names.find(',' + controller + ',') == std::string::npos)
      continue;
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path(); !group.empty();
         group = group.parent_path())
      folders.push_back(mounted / controller / group);
  }
  folders.push_back(mounted / controller);
  return folders;
}

std::uint64_t left(std::uint64_t limit, std::uint64_t used) {
  return limit == unlimited || used == unlimited ? unlimited : limit - std::min(limit, used);
}

double share(std::uint64_t quota, std::uint64_t period) {
  return quota == unlimited || period == unlimited || period == 0 ? std::numeric_limits<double>::infinity()
                                                                  : double(quota) / double(period);
}

// "150000 100000", or "max 100000".
double share_in(const fs::path& cpu_max) {
  std::ifstream in(cpu_max);
  std::uint64_t quota = 0, period = 0;
  return in >> quota >> period ? share(quota, period) : std::numeric_limits<double>::infinity();
}

}  // namespace

std::uint64_t ControlGroups::memory() const {
  std::uint64_t least = unlimited;
  for (const fs::path& group : folders_of("", mounted_, own_))
    least = std::min(least, left(number_in(group / "memory.max"), number_in(group / "memory.current")));
  for (const fs::path& group : folders_of("memory", mounted_, own_))
    least = std::min(
        least, left(number_in(group / "memory.limit_in_bytes"), number_in(group / "memory.usage_in_bytes")));
  return least;
}

double ControlGroups::processors() const {
  double least = std::numeric_limits<double>::infinity();
  for (const fs::path& group : folders_of("", mounted_, own_))
    least = std::min(least, share_in(group / "cpu.max"));
  for (const fs::path& group : folders_of("cpu", mounted_, own_))
    least =
        std::min(least, share(number_in(group / "cpu.cfs_quota_us"), number_in(group / "cpu.cfs_period_us")));
  return least;
}

}  // namespace nook
