#include "record.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.hpp"

namespace nook::bench {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
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
  if (!out.flush()) throw Error(ExitCode::output, "cannot write " + file);
}

}  // namespace nook::bench
