#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// Adds `nook_bench occlusion` to the command line.
void add_occlusion(CLI::App& app);

}  // namespace nook::bench
