#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

namespace nook {

/// A command's file adds its subcommand and, when the user names it, stores here what to run (the result is
/// the exit code).
using Command = std::function<int()>;

void add_render_command(CLI::App& app, Command& chosen);
void add_probe_command(CLI::App& app, Command& chosen);
void add_plan_command(CLI::App& app, Command& chosen);
void add_deliver_command(CLI::App& app, Command& chosen);
void add_bake_command(CLI::App& app, Command& chosen);
void add_info_command(CLI::App& app, Command& chosen);
void add_merge_command(CLI::App& app, Command& chosen);
void add_compare_command(CLI::App& app, Command& chosen);
void add_study_command(CLI::App& app, Command& chosen);
void add_devices_command(CLI::App& app, Command& chosen);
void add_doctor_command(CLI::App& app, Command& chosen);

/// nook with every command; `chosen` must outlive it.
std::unique_ptr<CLI::App> make_command_line(Command& chosen);

}  // namespace nook
