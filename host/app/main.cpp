// One catch block.
#include <fmt/format.h>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <memory>
#include <new>
#include <string>

#include "app/commands.hpp"
#include "base/error.hpp"

namespace {

// One line, whatever bytes of a file or an argument it quotes.
int report(std::string message, nook::ExitCode code) {
  for (char& c : message)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  fmt::print(stderr, "nook: {}\n", message);
  return int(code);
}

}  // namespace

int main(int argc, char** argv) {
  using nook::ExitCode;
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), like a full disk
  nook::Command chosen;
  const std::unique_ptr<CLI::App> app = nook::make_command_line(chosen);
  try {
    app->parse(argc, argv);
    if (!chosen) return report("no command was given; nook --help lists them", ExitCode::usage);
    const int code = chosen();
    return std::fflush(stdout) == 0 ? code : report("stdout: cannot write", ExitCode::output);
  } catch (const CLI::Success& e) {
    return app->exit(e);
  } catch (const CLI::ParseError& e) {
    return report(e.what(), ExitCode::usage);
  } catch (const nook::Error& e) {
    return report(e.what(), e.code());
  } catch (const std::bad_alloc&) {
    return report("out of memory", ExitCode::device);
  } catch (const std::exception& e) {
    return report(e.what(), ExitCode::internal);
  }
}
