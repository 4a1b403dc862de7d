#include <algorithm>

#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

// Every second bit of a 10-bit Morton code.
std::uint32_t compact(std::uint32_t code) {
  std::uint32_t value = 0;
  for (unsigned bit = 0; bit < 5; ++bit) value |= (code >> (2 * bit) & 1u) << bit;
  return value;
}

}  // namespace

std::vector<std::uint32_t> pixels_in_order(const PixelRect& window, int width) {
  constexpr int tile = 32;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(std::size_t(window.width()) * std::size_t(window.height()));
  for (int top = window.y0; top < window.y1; top += tile)
    for (int left = window.x0; left < window.x1; left += tile)
      for (std::uint32_t code = 0; code < tile * tile; ++code) {
        const int x = left + int(compact(code)), y = top + int(compact(code >> 1));
        if (x < window.x1 && y < window.y1)
          pixels.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
      }
  return pixels;
}

}  // namespace nook
