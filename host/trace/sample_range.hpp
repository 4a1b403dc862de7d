#pragma once

#include <cstdint>

namespace nook {

/// Samples [first, first + count) of a pixel: of its Plan::samples_per_pixel() camera rays or, with one
/// camera ray a pixel, directions.
struct SampleRange {
  std::uint32_t first = 0, count = 0;
};

}  // namespace nook
