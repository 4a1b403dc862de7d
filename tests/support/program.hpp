#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nook::test {

/// What a program did.
struct ProgramResult {
  int code = 0;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
  double seconds = 0;
};

struct ProgramSetting {
  std::vector<std::string> arguments;
  std::filesystem::path folder;  ///< to run in; empty: this process's
  std::vector<std::pair<std::string, std::string>>
      environment;  ///< added; an empty value removes the variable
  /// RLIMIT_FSIZE and the like, soft and hard; writing beyond a file size fails as on a full disk (EFBIG).
  std::vector<std::pair<int, rlim_t>> limits = {};
  bool one_processor = false;   ///< its mask (taskset) is of the first that this process may use
  std::string standard_output;  ///< a file to write to instead of ProgramResult::out, e.g. /dev/full
  std::string standard_error;   ///< likewise; "closed" closes it
  std::string standard_input = "/dev/null";  ///< a file
  double timeout = 60;                       ///< seconds; then it is killed, and the result's code is 137
};

/// A program under way, its output collected; killed if it still runs when destroyed.
class RunningProgram {
 public:
  RunningProgram(const std::string& program, const ProgramSetting& setting);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  pid_t process() const { return child_; }
  /// Waits for at most the setting's timeout. False: it still runs.
  bool ended_within(double seconds);
  ProgramResult wait();

 private:
  pid_t child_ = -1;
  int status_ = 0;
  bool ended_ = false;
  double start_ = 0, timeout_ = 0;
  std::filesystem::path output_, errors_;
};

ProgramResult run_program(const std::string& program, const ProgramSetting& setting);

}  // namespace nook::test
