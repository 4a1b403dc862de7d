#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "image/image.hpp"

namespace nook {

enum class ExrPrecision { full, half };

/// Writes a scanline, ZIP-compressed OpenEXR file: FLOAT and UINT channels, string attributes for the
/// metadata. Goes to a temporary name in the same folder and is renamed when complete: a failure leaves no
/// partial file. Throws Error(output) with one line. ExrPrecision::half: HALF channels instead of FLOAT ones,
/// rounded to nearest. Compresses with threads_to_use() threads, as they are at the first call.
void write_exr(const std::filesystem::path& path, const Image& image,
               ExrPrecision precision = ExrPrecision::full);

/// Reads every channel of a (single-part, scanline or tiled) OpenEXR file; HALF becomes float.
/// Throws Error(scene) with one line, also when the header claims more pixels than the file can hold.
Image read_exr(const std::filesystem::path& path);

/// The text attributes of such a file, without its pixels. Throws Error(scene) with one line.
std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path);

}  // namespace nook
