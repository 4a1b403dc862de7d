#include "bench/support/child.hpp"

#include <spawn.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>

#include "base/error.hpp"

namespace nook::bench {
namespace {

double seconds(const timeval& t) {
  return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

bool wait_for(pid_t pid, int& status, rusage& usage) {
  while (wait4(pid, &status, 0, &usage) < 0)
    if (errno != EINTR) return false;
  return true;
}

}  // namespace

int run_and_report(int argc, char** argv) {
  if (argc < 2) return 1;
  std::vector<char*> command(argv + 1, argv + argc);
  command.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  pid_t pid = 0;
  if (posix_spawn(&pid, command[0], nullptr, nullptr, command.data(), environ) != 0) return 1;
  int status = 0;
  rusage usage{};
  if (!wait_for(pid, status, usage) || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return 1;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::ofstream out(argv[0]);
  out.precision(17);
  out << wall << ' ' << seconds(usage.ru_utime) + seconds(usage.ru_stime) << ' '
      << 1024.0 * double(usage.ru_maxrss);
  return out.flush() ? 0 : 1;
}

ChildTimes run_child(const std::vector<std::string>& command,
                     const std::map<std::string, std::string>& environment) {
  const TemporaryFolder folder;
  const std::string report = folder / "times";
  std::vector<std::string> arguments = {program_beside("nook_bench"), child_command, report}, variables;
  arguments.insert(arguments.end(), command.begin(), command.end());
  for (char** v = environ; *v; ++v) {
    const std::string text = *v;
    if (!environment.contains(text.substr(0, text.find('=')))) variables.push_back(text);
  }
  for (const auto& [name, value] : environment) variables.push_back(name + "=" + value);
  pid_t pid = 0;
  int status = 0;
  rusage usage{};
  if (posix_spawn(&pid, arguments[0].c_str(), nullptr, nullptr, pointers(arguments).data(),
                  pointers(variables).data()) != 0 ||
      !wait_for(pid, status, usage) || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(ErrorKind::internal, command[0] + " cannot be started, or failed");
  ChildTimes times;
  if (!(std::ifstream(report) >> times.wall_seconds >> times.cpu_seconds >> times.peak_bytes))
    throw Error(ErrorKind::internal, command[0] + " ran, but its times are not known");
  return times;
}

std::filesystem::path program_beside(const std::string& name) {
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  if (!std::filesystem::exists(path)) throw Error(ErrorKind::usage, path.string() + ": is not built");
  return path;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "nook-bench-XXXXXX").string();
  if (!mkdtemp(name.data())) throw Error(ErrorKind::output, name + ": cannot be made");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace nook::bench
