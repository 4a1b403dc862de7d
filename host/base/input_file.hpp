#pragma once

#include <cstdint>
#include <filesystem>

namespace nook {

/// The size in bytes of a file that a user named, which must be there and be a regular file: a folder, a FIFO
/// or a device could keep a reader waiting for ever, or never end. Throws Error(scene): "PATH: no such file",
/// "PATH: not a regular file".
std::uint64_t size_of_input(const std::filesystem::path& path);

}  // namespace nook
