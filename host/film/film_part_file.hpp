#pragma once

#include <filesystem>
#include <string>

#include "film/film_part.hpp"

namespace nook {

/// Writes a part's file: under a temporary name, flushed to the disk, then renamed, so that a crash at any
/// moment leaves the older file or the new one. Throws Error(output).
void write_film_part(const std::filesystem::path& path, const FilmPart& part);

/// Reads it back. Throws Error(scene) with one line for anything but a whole file with good checksums; memory
/// is taken only for what the file's size can hold.
FilmPart read_film_part(const std::filesystem::path& path);

/// Adds the samples of `other` to `part`: in any order and grouping the same bits. The names are what
/// messages call them. Throws Error(scene) with one line if they differ in identity, or hold the same samples
/// of a pixel; `part` is unchanged then.
void join_film_part(FilmPart& part, const std::string& name, const FilmPart& other,
                    const std::string& other_name);

/// "a.nook and b.nook differ in seed: 3 and 7" for the first difference in identity; "" if there is none.
std::string difference(const FilmPart& a, const std::string& name_a, const FilmPart& b,
                       const std::string& name_b);

}  // namespace nook
