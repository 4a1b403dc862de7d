#pragma once

#include <cstdint>

namespace nook {

/// What lies behind a picture in its preview: nothing (alpha), or a color, sRGB encoded.
struct Background {
  bool transparent = false;
  std::uint8_t red = 0, green = 0, blue = 0;

  bool operator==(const Background&) const = default;
};

}  // namespace nook
