#include "device/prepare.hpp"

#include "base/driver_threads.hpp"
#include "base/threads.hpp"
#include "device/pocl_folder.hpp"

namespace nook {

void prepare_for_opencl(unsigned threads) {
  limit_own_threads(threads);
  limit_driver_threads(threads);
  prepare_for_pocl();
}

}  // namespace nook
