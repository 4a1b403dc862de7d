#pragma once

#include <cstdint>
#include <string>

namespace nook {

/// Bytes that this process can still take without pushing others out: what the kernel calls available, less
/// where a control group sets a lower limit.
std::uint64_t available_memory();

/// Throws Error(device) "<what> needs 120.5 GiB of memory, 12.1 GiB are free: <remedy>" if it does not fit.
void check_memory(std::uint64_t bytes, const std::string& what, const std::string& remedy);

}  // namespace nook
