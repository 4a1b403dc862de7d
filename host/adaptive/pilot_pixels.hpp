#pragma once

#include <cstdint>
#include <vector>

namespace nook {

/// Positions in pixels_in_order() of about `wanted` of so many pixels: runs of 64 neighbours, spread evenly,
/// whose rays are as coherent as those of the whole picture. Of all, if there are fewer.
std::vector<std::uint32_t> pilot_pixels(std::size_t pixels, std::size_t wanted);

}  // namespace nook
