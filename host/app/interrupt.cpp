#include "app/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace nook {
namespace {

volatile std::sig_atomic_t signalled = 0;

void on_signal(int number) {
  signalled = 1;
  std::signal(number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  // Ignored ones stay so: nohup's, and those of a shell's background jobs.
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

bool interrupted() {
  return signalled != 0;
}

}  // namespace nook
