#include "trace/randomisations.hpp"

#include <algorithm>

namespace nook {

std::vector<Randomisations::Piece> Randomisations::pieces(SampleRange range) const {
  if (count == 1) return {{0, range.first, range}};
  std::vector<Piece> made;
  const std::uint64_t end = std::uint64_t(range.first) + range.count;
  std::uint64_t stage_first = 0;  // in the session's numbering
  std::uint32_t before = 0;
  for (const std::uint32_t stage : stages) {
    const std::uint32_t size = stage - before;
    for (std::uint32_t r = 0; r < count; ++r, stage_first += size) {
      const std::uint64_t from = std::max<std::uint64_t>(range.first, stage_first),
                          to = std::min(end, stage_first + size);
      if (from < to)
        made.push_back(
            {r, std::uint32_t(from), {before + std::uint32_t(from - stage_first), std::uint32_t(to - from)}});
    }
    before = stage;
  }
  return made;
}

std::uint32_t Randomisations::samples_of(std::uint32_t r, std::uint32_t n) const {
  if (count == 1) return n;
  std::uint64_t stage_first = 0;
  std::uint32_t before = 0;
  for (const std::uint32_t stage : stages) {
    const std::uint64_t size = stage - before, next = stage_first + size * count;
    if (n < next) {
      const std::uint64_t first = stage_first + r * size;
      return before + std::uint32_t(n > first ? std::min<std::uint64_t>(n - first, size) : 0);
    }
    stage_first = next;
    before = stage;
  }
  return before;
}

// A hash (Steele, Lea and Flood 2014, splitmix64): neighbouring seeds share no randomisation.
std::uint32_t Randomisations::seed_of(std::uint32_t seed, std::uint32_t r) {
  std::uint64_t x = (std::uint64_t(seed) << 32 | r) + 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return std::uint32_t((x ^ (x >> 31)) >> 32);
}

}  // namespace nook
