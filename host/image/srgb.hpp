#pragma once

#include <cstdint>

namespace nook {

/// A linear value in [0,1] as an 8-bit sRGB code, IEC 61966-2-1, rounded to the nearest code. Values outside
/// are clamped, NaN is 0.
std::uint8_t srgb_byte(float linear);

/// The linear value in [0,1] that an sRGB code stands for; srgb_byte() of it is the code.
double linear_of(std::uint8_t srgb);

}  // namespace nook
