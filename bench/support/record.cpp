#include "bench/support/record.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.hpp"
#include "device/device.hpp"
#include "support/embree.hpp"

namespace nook::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string system_name() {
  std::ifstream file("/etc/os-release");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("PRETTY_NAME=", 0) == 0) return line.substr(13, line.size() - 14);
  return "unknown system";
}

}  // namespace

std::string machine_description() {
  const DeviceInfo device = select_device("");
  return fmt::format(
      "{}, {} hardware threads, {:.0f} GB; {}; {} {} ({}, vectors of {} floats); Embree {}; GCC {}.\n",
      processor(), std::thread::hardware_concurrency(),
      double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)) * 1e-9, system_name(),
      device.platform_name, device.driver, device.name, device.native_float_width, RTC_VERSION_STRING,
      __VERSION__);
}

void append_record(const std::string& file, nlohmann::json record) {
  if (file.empty()) return;
  const std::time_t now = std::time(nullptr);
  char date[32];
  std::strftime(date, sizeof(date), "%Y-%m-%d", std::gmtime(&now));
  record["date"] = date;
  record["processor"] = processor();
  record["hardware_threads"] = std::thread::hardware_concurrency();
  record["compiler"] = __VERSION__;
  std::ofstream out(file, std::ios::app);
  out << record.dump() << '\n';
  if (!out.flush()) throw Error(ErrorKind::output, "cannot write " + file);
}

}  // namespace nook::bench
