#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// Adds `nook_bench end-to-end`: whole processes, nook against our Embree program.
void add_end_to_end(CLI::App& app);

/// Adds `nook_bench overhead`: what a process takes before its first ray.
void add_overhead(CLI::App& app);

}  // namespace nook::bench
