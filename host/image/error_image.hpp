#pragma once

#include <filesystem>

#include "image/image.hpp"

namespace nook {

/// Shows signed differences (a - b, one plane a channel). A name ending in .exr gets the values themselves;
/// any other a PNG: each pixel's difference of largest magnitude, white for 0, red above and blue below, full
/// colour from `full_scale` on; NaN and infinity are black. Returns full_scale: the 99th percentile of the
/// magnitudes, or 1 if that is 0. Throws Error(output).
double write_error_image(const std::filesystem::path& path, const Image& difference);

}  // namespace nook
