#include "base/threads.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "base/control_group.hpp"

namespace nook {
namespace {

std::atomic<unsigned> limit = 0;

}  // namespace

unsigned processors_allowed() {
  // The C library counts those of the mask.
  static const unsigned allowed = unsigned(std::max(
      1., std::min(double(std::thread::hardware_concurrency()), std::ceil(ControlGroups().processors()))));
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
