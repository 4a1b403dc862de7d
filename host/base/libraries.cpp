#include "base/libraries.hpp"

#include <algorithm>
#include <fstream>
#include <set>

namespace nook {

std::vector<std::string> mapped_libraries() {
  static constexpr const char* families[] = {"OpenCL", "opencl",  "pocl",     "OSMesa", "libGL",
                                             "libEGL", "libLLVM", "intelocl", "gallium"};
  std::set<std::string> found;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::string name = line.substr(line.rfind('/') + 1);
    const bool library = line.find('/') != std::string::npos && name.find(".so") != std::string::npos;
    if (library && std::any_of(std::begin(families), std::end(families),
                               [&](const char* f) { return name.find(f) != std::string::npos; }))
      found.insert(name);
  }
  return {found.begin(), found.end()};
}

}  // namespace nook
