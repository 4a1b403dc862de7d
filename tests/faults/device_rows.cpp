#include "row_kinds.hpp"

namespace nook::test {

std::vector<BadInput> device_rows() {
  return {
      {"no OpenCL platform",
       render,
       4,
       "no OpenCL device found",
       {},
       {},
       {},
       {},
       {},
       {{"OCL_ICD_VENDORS", "/nonexistent"}}},
      {"no OpenCL loader",
       render,
       4,
       "no OpenCL loader",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", "/nonexistent.so"}}},
      {"device that matches nothing", render + " --device quantum", 4, "no OpenCL device matches 'quantum'"},
      {"device index that is not there", render + " --device 7:7", 4, "no OpenCL device matches '7:7'"},
      {"device out of memory",
       render,
       4,
       "bytes asked",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_ALLOCATION", "1000"}}},
      {"device lost",
       render,
       4,
       "CL_OUT_OF_RESOURCES; nothing was written",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_LAUNCH", "2"}}},
  };
}

}  // namespace nook::test
