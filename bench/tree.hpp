#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// Adds `nook_bench tree`: building our tree against rtcCommitScene.
void add_tree(CLI::App& app);

}  // namespace nook::bench
