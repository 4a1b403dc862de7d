#pragma once

#include <string>
#include <vector>

namespace nook {

/// The file names of the OpenCL, OpenGL and LLVM libraries that this process has mapped, sorted: the proof of
/// what a run loaded. Empty where the system does not tell (/proc/self/maps).
std::vector<std::string> mapped_libraries();

}  // namespace nook
