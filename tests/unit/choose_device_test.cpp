#include <gtest/gtest.h>

#include "device/device.hpp"

namespace nook {
namespace {

DeviceInfo device(unsigned platform, cl_device_type type, const char* platform_name, const char* name) {
  DeviceInfo made;
  made.platform_index = platform;
  made.type = type;
  made.platform_name = platform_name;
  made.name = name;
  return made;
}

const DeviceInfo oclgrind =
    device(0, CL_DEVICE_TYPE_CPU | CL_DEVICE_TYPE_GPU, "Oclgrind", "Oclgrind Simulator");
const DeviceInfo llvmpipe = device(1, CL_DEVICE_TYPE_CPU, "rusticl", "llvmpipe (LLVM 19.1.7, 256 bits)");
const DeviceInfo gpu = device(2, CL_DEVICE_TYPE_GPU, "rusticl", "AMD Radeon RX 6600 (radeonsi)");
const DeviceInfo pocl =
    device(3, CL_DEVICE_TYPE_CPU, "Portable Computing Language", "pthread-skylake-avx512");
const DeviceInfo accelerator = device(4, CL_DEVICE_TYPE_ACCELERATOR, "Altera", "board");

unsigned chosen(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  const DeviceInfo* found = choose_device(devices, selector);
  return found ? found->platform_index : 99;
}

TEST(ChooseDevice, PassesOverInterpretersAndSoftwareGpus) {
  EXPECT_EQ(chosen({oclgrind, llvmpipe, gpu, pocl}, ""), 3u);
  EXPECT_EQ(chosen({oclgrind, llvmpipe, gpu}, ""), 2u);
  EXPECT_EQ(chosen({oclgrind, llvmpipe}, ""), 0u) << "better than none";
  EXPECT_EQ(chosen({oclgrind, llvmpipe, pocl}, "cpu"), 3u);
  EXPECT_EQ(chosen({oclgrind, gpu, pocl}, "gpu"), 2u);
  EXPECT_EQ(chosen({accelerator}, ""), 4u);
  EXPECT_EQ(chosen({}, ""), 99u);
}

TEST(ChooseDevice, TakesTheOneThatIsNamed) {
  const std::vector<DeviceInfo> all = {oclgrind, llvmpipe, gpu, pocl};
  EXPECT_EQ(chosen(all, "oclgrind"), 0u);
  EXPECT_EQ(chosen(all, "LLVMpipe"), 1u);
  EXPECT_EQ(chosen(all, "rusticl"), 2u) << "of two the fast one";
  EXPECT_EQ(chosen(all, "1:0"), 1u);
  EXPECT_EQ(chosen(all, "1:1"), 99u);
  EXPECT_EQ(chosen(all, "quantum"), 99u);
}

}  // namespace
}  // namespace nook
