// The command line: one subcommand a file, one catch block.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <new>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "base/version.hpp"

namespace {

int report(const char* message, nook::ExitCode code) {
  fmt::print(stderr, "nook: {}\n", message);
  return int(code);
}

}  // namespace

int main(int argc, char** argv) {
  using nook::ExitCode;
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), like a full disk
  CLI::App app("nook: ambient occlusion, reflection occlusion and screen-space ambient occlusion");
  app.set_version_flag("--version", "nook " + std::string(nook::version));
  app.require_subcommand(0, 1);
  app.footer(
      "Exit codes: 0 ok, 1 defect, 2 usage, 3 scene, 4 device, 5 target missed, 6 output, 130 interrupted.");
  nook::Command chosen;
  nook::add_render_command(app, chosen);
  nook::add_probe_command(app, chosen);
  nook::add_plan_command(app, chosen);
  nook::add_deliver_command(app, chosen);
  nook::add_bake_command(app, chosen);
  nook::add_info_command(app, chosen);
  nook::add_compare_command(app, chosen);
  nook::add_merge_command(app, chosen);
  nook::add_study_command(app, chosen);
  nook::add_devices_command(app, chosen);
  nook::add_doctor_command(app, chosen);
  try {
    app.parse(argc, argv);
    if (!chosen) return report("no command was given; nook --help lists them", ExitCode::usage);
    const int code = chosen();
    return std::fflush(stdout) == 0 ? code : report("stdout: cannot write", ExitCode::output);
  } catch (const CLI::Success& e) {
    return app.exit(e);
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
