#pragma once

#include <filesystem>

#include "film/image.hpp"

namespace nook {

/// Writes channels R, G, B as an 8-bit PNG: the data as it is, clamped to [0,1], sRGB encoded (IEC
/// 61966-2-1), NaN as 0. Gray when R = G = B. Temporary name and rename, as write_exr. Throws Error(output).
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace nook
