#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image.hpp"
#include "math/background.hpp"

namespace nook {

/// Writes channels R, G, B as an 8-bit PNG: the data as it is, clamped to [0,1], sRGB encoded (IEC
/// 61966-2-1), NaN as 0. Gray when R = G = B. Over a background, the light of what is seen and
/// the background's where nothing is add up, linearly; a ground (Image::ground) has the background's color
/// times its value. With alpha a pixel looks like that over white and over black, in viewers that blend
/// encoded values: a ground is its shadow alone. Temporary name and rename, as write_exr. Throws
/// Error(output).
void write_png(const std::filesystem::path& path, const Image& image, const Background& background = {});

/// One number a pixel, row 0 at the top.
struct GrayImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> values;
};

/// The opacity in a PNG of any kind: its alpha channel or, if it has none, its gray (of colors: Rec. 709
/// luminance of the values as they are); 8 bits, of 16 the upper. Or what `channel` names: r, g, b; l: its
/// gray; m: its alpha, 255 if it has none. Throws Error(scene) with one line: missing,
/// not a regular file, damaged, over 16384 pixels a side.
GrayImage read_png_opacity(const std::filesystem::path& path, char channel = 0);

}  // namespace nook
