#include "adaptive/pilot_pixels.hpp"

#include <algorithm>

namespace nook {

std::vector<std::uint32_t> pilot_pixels(std::size_t pixels, std::size_t wanted) {
  constexpr std::size_t run_length = 64;
  const std::size_t runs = std::max<std::size_t>(1, pixels / run_length);
  const std::size_t step = std::max<std::size_t>(1, runs * run_length / std::max<std::size_t>(wanted, 1));
  std::vector<std::uint32_t> chosen;
  for (std::size_t run = step / 2; run < runs; run += step)
    for (std::size_t i = run * run_length; i < std::min(pixels, (run + 1) * run_length); ++i)
      chosen.push_back(std::uint32_t(i));
  if (chosen.empty())
    for (std::size_t i = 0; i < pixels; ++i) chosen.push_back(std::uint32_t(i));
  return chosen;
}

}  // namespace nook
