#include "image/srgb.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace nook {

namespace {

/// The inverse transfer function: encoded in [0,1] to linear.
double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Codes by comparison instead of a pow per pixel: threshold[c] is where code c ends, and first[i] the code
/// at i/bins. The curve's steepest part has 12.92 * 255 codes per unit, fewer than the bins, so a bin holds
/// one threshold at most.
struct Table {
  static constexpr int bins = 4096;
  std::array<float, 256> threshold{};
  std::array<std::uint8_t, bins + 1> first{};

  Table() {
    for (int code = 0; code < 255; ++code)
      threshold[code] = static_cast<float>(srgb_to_linear((code + 0.5) / 255));
    threshold[255] = std::numeric_limits<float>::infinity();
    int code = 0;
    for (int bin = 0; bin <= bins; ++bin) {
      while (static_cast<float>(bin) / bins >= threshold[code]) ++code;
      first[bin] = static_cast<std::uint8_t>(code);
    }
  }
};

}  // namespace

std::uint8_t srgb_byte(float linear) {
  static const Table table;
  if (!(linear > 0)) return 0;  // also NaN
  if (linear >= 1) return 255;
  const std::uint8_t code = table.first[static_cast<int>(linear * Table::bins)];
  return linear >= table.threshold[code] ? code + 1 : code;
}

double linear_of(std::uint8_t srgb) {
  return srgb_to_linear(srgb / 255.0);
}

}  // namespace nook
