#pragma once

#include <filesystem>
#include <string_view>

#include "base/large_vector.hpp"

namespace nook {

/// The bytes of a mesh file; of a name that ends in .gz (any case) those that it holds, decompressed. Throws
/// Error(scene) with one line: missing, not a regular file, damaged, more than fit into memory.
LargeVector<char> read_mesh_file(const std::filesystem::path& path);

/// A text without the byte order mark of UTF-8 before it. Throws Error(scene) "NAME: the text is UTF-16; ..."
/// for those of UTF-16.
std::string_view without_byte_order_mark(std::string_view text, const std::filesystem::path& name);

}  // namespace nook
