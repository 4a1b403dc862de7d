#include "base/driver_threads.hpp"

#include <cstdlib>
#include <string>

#include "base/threads.hpp"

namespace nook {

std::span<const DriverThreads> driver_threads() {
  static constexpr DriverThreads all[] = {{"PoCL to 4", "POCL_MAX_PTHREAD_COUNT"},
                                          {"PoCL from 5", "POCL_CPU_MAX_CU_COUNT"},
                                          {"Intel's runtime", "CL_CONFIG_CPU_TBB_NUM_WORKERS"},
                                          {"llvmpipe", "LP_NUM_THREADS"},
                                          {"oclgrind", "OCLGRIND_NUM_THREADS"}};
  return all;
}

void limit_driver_threads(unsigned threads) {
  const std::string number = std::to_string(threads_to_use(threads));
  for (const DriverThreads& driver : driver_threads()) setenv(driver.variable, number.c_str(), threads != 0);
}

}  // namespace nook
