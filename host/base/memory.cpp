#include "base/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/control_group.hpp"
#include "base/error.hpp"

namespace nook {
namespace {

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

}  // namespace

std::uint64_t available_memory() {
  return std::min(system_memory(), ControlGroups().memory());
}

void check_memory(std::uint64_t bytes, const std::string& what, const std::string& remedy) {
  const std::uint64_t free = available_memory();
  constexpr double gibibyte = double(1u << 30);
  if (bytes > free)
    throw Error(ErrorKind::device, fmt::format("{} needs {:.1f} GiB of memory, {:.1f} GiB are free: {}", what,
                                               double(bytes) / gibibyte, double(free) / gibibyte, remedy));
}

}  // namespace nook
