#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// `nook_bench instances`: a mesh placed many times, as trees in place against copies: whole processes.
void add_instances(CLI::App& app);

}  // namespace nook::bench
