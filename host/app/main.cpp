// One catch block.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"

namespace {

// One line, whatever bytes of a file or an argument it quotes.
int report(std::string message, nook::ExitCode code) {
  for (char& c : message)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  nook::to_stderr("nook: {}\n", message);
  return int(code);
}

// Descriptors 0 to 2 are taken, at least by /dev/null: the next file that was opened would else be one of
// them, and get the messages.
void keep_standard_descriptors() {
  for (int file = ::open("/dev/null", O_RDWR); file >= 0 && file <= 2; file = ::open("/dev/null", O_RDWR))
    if (file == 2) return;
}

// A driver that gives up calls abort(), after a line of its own. What it needs is checked before
// (check_what_pocl_needs()); this is for what is not known yet.
void on_abort(int) {
  constexpr char line[] = "nook: a library has aborted the process, most likely the OpenCL driver\n";
  if (::write(STDERR_FILENO, line, sizeof line - 1)) {
  }
  ::_exit(int(nook::ExitCode::device));
}

void set_signals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), like a full disk
  std::signal(SIGPIPE, SIG_IGN);  // and so is a reader of stderr that went away
  std::signal(SIGABRT, on_abort);
  std::set_terminate([] {
    nook::to_stderr("nook: a defect: an exception that nobody caught\n");
    ::_exit(int(nook::ExitCode::internal));
  });
}

int checked_stdout(int code) {
  const bool written = std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout.flush();
  return written ? code : report("stdout: cannot write", nook::ExitCode::output);
}

}  // namespace

int main(int argc, char** argv) {
  using nook::ExitCode;
  keep_standard_descriptors();
  set_signals();
  nook::Command chosen;
  const std::unique_ptr<CLI::App> app = nook::make_command_line(chosen);
  try {
    app->parse(argc, argv);
    if (!chosen) return report("no command was given; nook --help lists them", ExitCode::usage);
    return checked_stdout(chosen());
  } catch (const CLI::Success& e) {
    return checked_stdout(app->exit(e));
  } catch (const CLI::ParseError& e) {
    return report(e.what(), ExitCode::usage);
  } catch (const nook::Error& e) {
    return report(e.what(), exit_code(e.kind()));
  } catch (const std::bad_alloc&) {
    return report("out of memory", ExitCode::device);
  } catch (const std::system_error& e) {
    if (std::ferror(stdout)) return report("stdout: cannot write", ExitCode::output);
    if (e.code() == std::errc::resource_unavailable_try_again)
      return report("the system allows no more threads (ulimit -u, or the control group's pids.max)",
                    ExitCode::device);
    return report(e.what(), ExitCode::internal);
  } catch (const std::exception& e) {
    return report(e.what(), ExitCode::internal);
  }
}
