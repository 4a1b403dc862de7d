#pragma once

#include <cstdint>
#include <vector>

#include "trace/sample_range.hpp"

namespace nook {

/// Independent randomisations of a point sequence, each with a seed of its own: their spread says how
/// accurate their mean is.
///
/// A session numbers their samples stage by stage: the first stages[0] samples of randomisation 0, of 1, ...,
/// then the samples [stages[0], stages[1]) of each, and so on. So a pixel with samples [0, n) of a session
/// has as even a share of each as can be.
struct Randomisations {
  std::uint32_t count = 1;
  std::vector<std::uint32_t> stages;  ///< samples of each randomisation after each stage, ascending

  /// A range of one randomisation's own samples, `first` in the session's numbering.
  struct Piece {
    std::uint32_t randomisation = 0;
    std::uint32_t first = 0;
    SampleRange range;
  };
  /// The pieces of a session's range.
  std::vector<Piece> pieces(SampleRange range) const;
  /// The samples of randomisation r among a session's samples [0, n).
  std::uint32_t samples_of(std::uint32_t r, std::uint32_t n) const;
  /// The seed of randomisation r: far from those of other seeds' randomisations.
  static std::uint32_t seed_of(std::uint32_t seed, std::uint32_t r);
};

}  // namespace nook
