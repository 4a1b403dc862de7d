#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// Adds `nook_bench ssao`: every method and quality against ray-traced AO.
void add_ssao(CLI::App& app);

}  // namespace nook::bench
