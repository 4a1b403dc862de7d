// nook doctor: what is missing or broken here, and the one command that mends it.
#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "device/device.hpp"
#include "device/kernel_source.hpp"
#include "device/program_cache.hpp"

namespace nook {
namespace {

bool say(bool good, const std::string& what, const std::string& mend = "") {
  fmt::print("{}  {}\n", good ? "ok     " : "PROBLEM", what);
  if (!good && !mend.empty()) fmt::print("         mend it with: {}\n", mend);
  return good;
}

bool check_opencl_devices() {
  try {
    opencl();
  } catch (const Error& e) {
    return say(false, e.what(), "apt-get install ocl-icd-libopencl1 pocl-opencl-icd");
  }
  say(true, "the OpenCL loader is there");
  const auto devices = list_devices();
  if (devices.empty())
    return say(false,
               "no OpenCL device: no driver is registered in /etc/OpenCL/vendors, or PoCL can write no cache "
               "(see below)",
               "apt-get install pocl-opencl-icd");
  for (const DeviceInfo& d : devices)
    say(true, fmt::format("OpenCL device {}:{} {} ({}, {})", d.platform_index, d.device_index, d.name,
                          d.platform_name, d.driver));
  return true;
}

bool check_kernels() {
  try {
    const Device device(select_device(""));
    BuiltProgram program = build_program(device, kernel_source("stage/occlusion.cl"), BuildOptions());
    program.store();
    return say(true, fmt::format("the kernels build ({:.2f} s{})", program.seconds,
                                 program.from_cache ? ", from the cache" : ""));
  } catch (const Error& e) {
    return say(false, e.what());
  }
}

bool check_cache() {
  const std::filesystem::path dir = program_cache_dir();
  if (dir.empty())
    return say(false, "no folder for the kernel cache: HOME is not set",
               "export NOOK_CACHE_DIR=/tmp/nook-cache");
  std::error_code code;
  std::filesystem::create_directories(dir, code);
  const std::filesystem::path trial = dir / fmt::format("doctor.{}.tmp", getpid());
  const bool writable = !code && bool(std::ofstream(trial) << "x" << std::flush);
  std::filesystem::remove(trial, code);
  return say(writable,
             fmt::format("the kernel cache {} is {}", dir.string(),
                         writable ? "writable" : "not writable: every run compiles"),
             "export NOOK_CACHE_DIR=/tmp/nook-cache");
}

bool check_osmesa() {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6"})
    if (void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL)) {
      dlclose(library);
      return say(true, fmt::format("{} is there (SSAO)", name));
    }
  return say(false, "no OSMesa: SSAO scenes cannot be rendered, everything else can",
             "apt-get install libosmesa6");
}

int run_doctor() {
  fmt::print("nook {} ({})\n", version, build_description);
  const bool device = check_opencl_devices();
  const bool kernels = device && check_kernels();
  const bool cache = check_cache();
  const bool osmesa = check_osmesa();
  return device && kernels && cache && osmesa ? 0 : int(ExitCode::device);
}

}  // namespace

void add_doctor_command(CLI::App& app, Command& chosen) {
  app.add_subcommand("doctor", "Explain what is missing or broken on this machine")->callback([&chosen] {
    chosen = run_doctor;
  });
}

}  // namespace nook
