#include "base/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"

namespace nook {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

// The first number in a file; unlimited if there is none ("max").
std::uint64_t number_in(const char* path) {
  std::ifstream in(path);
  std::uint64_t value = 0;
  return in >> value ? value : unlimited;
}

std::uint64_t system_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t kibibytes = 0;
    if (words >> name >> kibibytes && name == "MemAvailable:") return kibibytes << 10;
  }
  return unlimited;
}

// What a control group (a container, a batch job) leaves of its limit; version 2, then version 1.
std::uint64_t group_memory() {
  std::uint64_t left = unlimited;
  const char* const files[][2] = {
      {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"},
      {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"}};
  for (const auto& [limit_file, usage_file] : files) {
    const std::uint64_t limit = number_in(limit_file), usage = number_in(usage_file);
    if (limit != unlimited && usage != unlimited) left = std::min(left, limit - std::min(limit, usage));
  }
  return left;
}

}  // namespace

std::uint64_t available_memory() {
  return std::min(system_memory(), group_memory());
}

void check_memory(std::uint64_t bytes, const std::string& what, const std::string& remedy) {
  const std::uint64_t free = available_memory();
  constexpr double gibibyte = double(1u << 30);
  if (bytes > free)
    throw Error(ExitCode::device, fmt::format("{} needs {:.1f} GiB of memory, {:.1f} GiB are free: {}", what,
                                              double(bytes) / gibibyte, double(free) / gibibyte, remedy));
}

}  // namespace nook
