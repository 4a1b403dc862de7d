#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "math/median.hpp"

namespace nook::bench {

/// Processor, cores, memory, system, OpenCL device and driver, Embree, compiler: what a table of results says
/// of where it was measured. Markdown.
std::string machine_description();

/// Adds what every result says (date, processor, compiler) and appends one JSON line to `file`; nothing if it
/// is empty. Throws Error(output).
void append_record(const std::string& file, nlohmann::json record);

}  // namespace nook::bench
