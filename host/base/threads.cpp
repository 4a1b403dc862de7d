#include "base/threads.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/control_group.hpp"

namespace nook {
namespace {

std::atomic<unsigned> limit = 0;

// The C library's count may be of all that the machine has. Masks of over 1024 processors do not fit the set.
unsigned processors_of_mask() {
  cpu_set_t mask;
  if (sched_getaffinity(0, sizeof mask, &mask) == 0) return unsigned(CPU_COUNT(&mask));
  return std::thread::hardware_concurrency();
}

}  // namespace

unsigned processors_allowed() {
  static const unsigned allowed =
      unsigned(std::max(1., std::min(double(processors_of_mask()), std::ceil(ControlGroups().processors()))));
  return allowed;
}

unsigned threads_to_use(unsigned asked) {
  if (asked == 0) asked = limit;
  return asked ? asked : processors_allowed();
}

void limit_own_threads(unsigned threads) {
  limit = threads;
}

}  // namespace nook
