#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nook {

/// Largest scene file, bytes.
inline constexpr std::uint64_t largest_scene_file = 16u << 20;
/// Arrays, tables and parts of a dotted key within one another, at most.
inline constexpr int deepest_nesting = 32;

/// Bounds a text before anything parses it: a parser's time and stack grow with its size and nesting. Throws
/// Error(scene) with one line that names `file` if it is larger than largest_scene_file, or nests deeper than
/// deepest_nesting (with row and column).
void check_toml_text(const std::string& text, const std::filesystem::path& file);

/// The text of a file, bounded likewise. Throws Error(scene) also where it cannot be read.
std::string read_toml_text(const std::filesystem::path& path);

}  // namespace nook
