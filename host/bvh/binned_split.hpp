#pragma once

#include <utility>

#include "bvh/references.hpp"

namespace nook {

/// A plane between two bins: references in bins below `bin` along `axis` go left.
struct Split {
  int axis = -1;  ///< -1: none was found
  int bin = 0;
  int bins = 0;
  Float4 offset{}, scale{};  ///< bin = (center - offset) * scale, on each axis
  std::uint32_t left_count = 0;

  Int4 bins_of(Float4 center) const {
    const Int4 last = Int4{} + (bins - 1), bin_ = __builtin_convertvector((center - offset) * scale, Int4);
    const Int4 low = bin_ < 0 ? Int4{} : bin_;
    return low > last ? last : low;
  }
  bool is_left(const Reference& r) const { return bins_of(r.center())[axis] < bin; }
};

/// The split of least cost by the surface area heuristic, both sides of which have references. The same with
/// and without a pool.
Split best_split(const Reference* references, std::uint32_t count, const Span4& span);
Split best_split(const Reference* references, std::uint32_t count, const Span4& span, TaskPool& pool);

/// Writes the left references to `to`, then the right ones, each in the order they had; what the two span.
std::pair<Span4, Span4> partition(const Reference* from, std::uint32_t count, const Split& split,
                                  Reference* to);
std::pair<Span4, Span4> partition(const Reference* from, std::uint32_t count, const Split& split,
                                  Reference* to, TaskPool& pool);

}  // namespace nook
