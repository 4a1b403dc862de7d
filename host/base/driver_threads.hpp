#pragma once

#include <span>

namespace nook {

/// An implementation of OpenCL or OpenGL on the processor, and the environment variable that tells it how
/// many threads to have. It is read once, when the implementation is loaded or makes its first device.
struct DriverThreads {
  const char *implementation, *variable;
};

/// All that are known. docs/portability.md has the same table.
std::span<const DriverThreads> driver_threads();

/// Sets every variable to `threads`. 0: to threads_to_use(), but for those that the user has set. Must be
/// called before the first implementation is loaded, and while no other thread runs.
void limit_driver_threads(unsigned threads);

}  // namespace nook
