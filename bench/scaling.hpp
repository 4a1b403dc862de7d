#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// Adds `nook_bench scaling`: time and memory against triangles, pixels, rays and threads, and what each
/// option costs.
void add_scaling(CLI::App& app);

}  // namespace nook::bench
