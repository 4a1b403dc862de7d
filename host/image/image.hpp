#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace nook {

/// One plane of an image, row-major, row 0 at the top.
struct Channel {
  std::string name;  ///< as in the EXR file: "R", "N.X", "AO.samples"
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;
};

/// A finished image: planes of width * height values, and text metadata.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;
  std::map<std::string, std::string> metadata;  ///< "nook/seed" -> "7"
  /// The share of each pixel's camera rays that hit something, for previews: no channel. Empty: all.
  std::vector<float> coverage = {};
  /// Of these, the share that hit a ground which is to look like the background: 1 or 0, by the pixel's
  /// centre. Empty: none.
  std::vector<float> ground = {};
  int x0 = 0, y0 = 0;                   ///< its first pixel in the whole image, of which it may be a crop
  int full_width = 0, full_height = 0;  ///< of the whole image; 0: this is all of it

  const Channel* find(std::string_view name) const {
    for (const Channel& channel : channels)
      if (channel.name == name) return &channel;
    return nullptr;
  }
};

}  // namespace nook
