#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/large_vector.hpp"
#include "math/types.hpp"

namespace nook {

/// Gives each place one index: a table of places with open addressing. -0 is 0; a NaN's place is its bits.
class VertexWelder {
 public:
  /// Places are kept in `positions`.
  explicit VertexWelder(LargeVector<dvec3>& positions) : positions_(positions), table_(1024, empty) {}

  std::uint32_t index_of(dvec3 place) {
    place += 0.0;
    if (2 * positions_.size() >= table_.size()) grow();
    std::uint32_t& slot = slot_of(place);
    if (slot == empty) {
      slot = std::uint32_t(positions_.size());
      positions_.push_back(place);
    }
    return slot;
  }

 private:
  static constexpr std::uint32_t empty = 0xffffffffu;

  static bool same(const dvec3& a, const dvec3& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
  }

  std::uint32_t& slot_of(const dvec3& place) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(place[axis])) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t at = hash & (table_.size() - 1);
    while (table_[at] != empty && !same(positions_[table_[at]], place)) at = (at + 1) & (table_.size() - 1);
    return table_[at];
  }

  void grow() {
    table_.assign(4 * table_.size(), empty);
    for (std::size_t i = 0; i < positions_.size(); ++i) slot_of(positions_[i]) = std::uint32_t(i);
  }

  LargeVector<dvec3>& positions_;
  std::vector<std::uint32_t> table_;  // a power of two of them, at most half in use
};

}  // namespace nook
