#include "base/threads.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

namespace nook {
namespace {

std::atomic<unsigned> limit = 0;

}  // namespace

unsigned threads_to_use(unsigned asked) {
  if (asked == 0) asked = limit;
  return asked ? asked : std::max(1u, std::thread::hardware_concurrency());
}

void limit_own_threads(unsigned threads) {
  limit = threads;
}

}  // namespace nook
