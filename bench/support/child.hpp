#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace nook::bench {

/// What a child process took from its start to its end.
struct ChildTimes {
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< user and system, of all its threads
  double peak_bytes = 0;   ///< resident
};

/// Runs a program to its end. Its output goes where ours goes; `environment` is added to ours. Throws
/// Error(internal) if it cannot be started or fails. A small process in between starts it (run_and_report),
/// since the peak of memory that the kernel counts for a program begins with that of its parent.
ChildTimes run_child(const std::vector<std::string>& command,
                     const std::map<std::string, std::string>& environment = {});

/// nook_bench's own command for the process in between: its arguments are FILE, where the times are written,
/// and the program with its arguments. Returns 0, or 1 if the program or the file failed.
constexpr const char* child_command = "run-child";
int run_and_report(int argc, char** argv);

/// A program of this build: it lies beside this one.
std::filesystem::path program_beside(const std::string& name);

/// A folder that is removed with what it holds.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace nook::bench
