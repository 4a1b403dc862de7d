#include "support/program.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "support/temporary_folder.hpp"

extern char** environ;

namespace nook::test {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::filesystem::path temporary_file() {
  std::string name = (std::filesystem::temp_directory_path() / "nook-output-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) throw std::runtime_error("cannot make " + name);
  ::close(descriptor);
  return name;
}

std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& added) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    bool replaced = false;
    for (const auto& [name, value] : added)
      replaced = replaced || std::string(*entry).starts_with(name + "=");
    if (!replaced) result.emplace_back(*entry);
  }
  for (const auto& [name, value] : added)
    if (!value.empty()) result.push_back(name + "=" + value);
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

void use_one_processor() {
  cpu_set_t allowed, one;
  ::sched_getaffinity(0, sizeof allowed, &allowed);
  CPU_ZERO(&one);
  for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
    if (CPU_ISSET(i, &allowed)) CPU_SET(i, &one);
  ::sched_setaffinity(0, sizeof one, &one);
}

}  // namespace

RunningProgram::RunningProgram(const std::string& program, const ProgramSetting& setting)
    : start_(now()), timeout_(setting.timeout), output_(temporary_file()), errors_(temporary_file()) {
  std::vector<std::string> arguments = setting.arguments;
  arguments.insert(arguments.begin(), program);
  std::vector<std::string> environment = environment_with(setting.environment);
  const std::vector<char*> argv = pointers(arguments), envp = pointers(environment);
  const std::string output = setting.standard_output.empty() ? output_.string() : setting.standard_output;
  const bool closed = setting.standard_error == "closed";
  const std::string errors =
      setting.standard_error.empty() || closed ? errors_.string() : setting.standard_error;
  child_ = ::fork();
  if (child_ < 0) throw std::runtime_error("cannot start " + program);
  if (child_ > 0) return;
  // Between fork and exec only what is safe in a signal handler: the parent has threads.
  const int out = ::open(output.c_str(), O_WRONLY | O_TRUNC), err = ::open(errors.c_str(), O_WRONLY);
  const int in = ::open(setting.standard_input.c_str(), O_RDONLY);
  if (::dup2(in, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(126);
  ::close_range(3, ~0u, 0);  // what whoever runs the tests left open counts towards a limit of open files
  if (!setting.folder.empty() && ::chdir(setting.folder.c_str()) != 0) ::_exit(126);
  if (closed) ::close(2);
  // What the tests' own parent ignores would stay ignored.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
  for (const auto& [resource, value] : setting.limits) {
    if (resource == RLIMIT_FSIZE) ::signal(SIGXFSZ, SIG_IGN);
    const rlimit both{value, value};
    ::setrlimit(resource, &both);
  }
  if (setting.one_processor) use_one_processor();
  ::execve(program.c_str(), argv.data(), envp.data());
  ::_exit(127);
}

RunningProgram::~RunningProgram() {
  if (!ended_) {
    send(SIGKILL);
    ::waitpid(child_, &status_, 0);
  }
  std::error_code ignored;
  std::filesystem::remove(output_, ignored);
  std::filesystem::remove(errors_, ignored);
}

void RunningProgram::send(int signal) const {
  if (!ended_) ::kill(child_, signal);
}

bool RunningProgram::ended_within(double seconds) {
  for (const double end = now() + seconds; !ended_;) {
    ended_ = ::waitpid(child_, &status_, WNOHANG) == child_;
    if (ended_ || now() > end) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return ended_;
}

ProgramResult RunningProgram::wait() {
  if (!ended_within(timeout_ - (now() - start_))) {
    send(SIGKILL);
    ::waitpid(child_, &status_, 0);
    ended_ = true;
  }
  ProgramResult result;
  result.code = WIFSIGNALED(status_) ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
  result.seconds = now() - start_;
  result.out = read_bytes(output_);
  result.err = read_bytes(errors_);
  return result;
}

ProgramResult run_program(const std::string& program, const ProgramSetting& setting) {
  return RunningProgram(program, setting).wait();
}

}  // namespace nook::test
