// The command line: one subcommand a file.
#include "app/commands.hpp"
#include "base/version.hpp"

namespace nook {

std::unique_ptr<CLI::App> make_command_line(Command& chosen) {
  auto app = std::make_unique<CLI::App>(
      "nook: ambient occlusion, reflection occlusion and screen-space ambient occlusion");
  app->set_version_flag("--version", "nook " + std::string(version));
  app->require_subcommand(0, 1);
  app->footer(
      "Exit codes: 0 ok, 1 defect, 2 usage, 3 scene, 4 device, 5 target missed, 6 output, 130 interrupted.");
  add_render_command(*app, chosen);
  add_probe_command(*app, chosen);
  add_plan_command(*app, chosen);
  add_deliver_command(*app, chosen);
  add_bake_command(*app, chosen);
  add_info_command(*app, chosen);
  add_compare_command(*app, chosen);
  add_merge_command(*app, chosen);
  add_study_command(*app, chosen);
  add_devices_command(*app, chosen);
  add_doctor_command(*app, chosen);
  return app;
}

}  // namespace nook
