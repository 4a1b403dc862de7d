#pragma once

#include <CLI/CLI.hpp>

namespace nook::bench {

/// `nook_bench effects`: what each effect and setting costs, against plain AO of the same picture.
void add_effects(CLI::App& app);

}  // namespace nook::bench
