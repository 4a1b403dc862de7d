#include "bvh/binned_split.hpp"

#include <algorithm>
#include <cmath>

namespace nook {
namespace {

constexpr int most_bins = 256;            // of nodes with many references, where a better plane costs least
constexpr std::uint32_t piece = 1 << 15;  // references a task, where several threads split one node

struct Bins {
  Box4 box[3][most_bins];
  std::uint32_t count[3][most_bins];

  explicit Bins(int bins = most_bins) {  // NOLINT(cppcoreguidelines-pro-type-member-init)
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(box[axis], bins, Box4::empty());
      std::fill_n(count[axis], bins, 0u);
    }
  }
  void add(const Split& grid, const Reference& r) {
    const Int4 bin = grid.bins_of(r.center());
    const Float4 low = r.low(), high = r.high();
    for (int axis = 0; axis < 3; ++axis) {
      box[axis][bin[axis]].add(low, high);
      ++count[axis][bin[axis]];
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < most_bins; ++i) {
        box[axis][i].add(other.box[axis][i]);
        count[axis][i] += other.count[axis][i];
      }
  }
};

// The bins along each axis. One without extent has the scale 0: all references share a bin there.
Split grid_of(std::uint32_t count, const Span4& span) {
  Split grid;
  grid.bins = count < 64 ? 16 : count < 1024 ? 32 : count < 65536 ? 128 : most_bins;
  grid.offset = span.centers.lo;
  const Float4 extent = span.centers.hi - span.centers.lo;
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = float(grid.bins) / extent[axis];
    grid.scale[axis] = std::isfinite(scale) ? scale : 0.0f;
  }
  grid.scale[3] = 0;
  grid.offset[3] = 0;
  return grid;
}

Split cheapest(const Bins& bins, const Split& grid, std::uint32_t total) {
  Split best = grid;
  float best_cost = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.scale[axis] == 0) continue;
    float left_cost[most_bins];
    std::uint32_t left_count[most_bins];
    Box4 box = Box4::empty();
    std::uint32_t count = 0;
    for (int i = 0; i < grid.bins - 1; ++i) {
      box.add(bins.box[axis][i]);
      count += bins.count[axis][i];
      left_cost[i + 1] = count ? box.half_area() * float(count) : 0.0f;
      left_count[i + 1] = count;
    }
    box = Box4::empty();
    count = 0;
    for (int i = grid.bins - 1; i > 0; --i) {
      box.add(bins.box[axis][i]);
      count += bins.count[axis][i];
      if (count == 0 || count == total) continue;
      const float cost = left_cost[i] + box.half_area() * float(count);
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best.axis = axis;
      best.bin = i;
      best.left_count = left_count[i];
    }
  }
  return best;
}

}  // namespace

Split best_split(const Reference* references, std::uint32_t count, const Span4& span) {
  const Split grid = grid_of(count, span);
  Bins bins(grid.bins);
  for (std::uint32_t i = 0; i < count; ++i) bins.add(grid, references[i]);
  return cheapest(bins, grid, count);
}

Split best_split(const Reference* references, std::uint32_t count, const Span4& span, TaskPool& pool) {
  const Split grid = grid_of(count, span);
  std::vector<Bins> pieces((count + piece - 1) / piece);
  pool.for_ranges(count, piece, [&](std::size_t begin, std::size_t end) {
    Bins& bins = pieces[begin / piece];
    for (std::size_t i = begin; i < end; ++i) bins.add(grid, references[i]);
  });
  for (std::size_t i = 1; i < pieces.size(); ++i) pieces[0].add(pieces[i]);
  return cheapest(pieces[0], grid, count);
}

std::pair<Span4, Span4> partition(const Reference* from, std::uint32_t count, const Split& split,
                                  Reference* to) {
  Span4 left, right;
  Reference *next_left = to, *next_right = to + split.left_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Reference& r = from[i];
    if (split.is_left(r)) {
      left.add(r);
      *next_left++ = r;
    } else {
      right.add(r);
      *next_right++ = r;
    }
  }
  return {left, right};
}

std::pair<Span4, Span4> partition(const Reference* from, std::uint32_t count, const Split& split,
                                  Reference* to, TaskPool& pool) {
  const std::size_t pieces = (count + piece - 1) / piece;
  std::vector<std::uint32_t> lefts(pieces + 1);  // left references before each piece
  pool.for_ranges(count, piece, [&](std::size_t begin, std::size_t end) {
    std::uint32_t& n = lefts[begin / piece + 1];
    for (std::size_t i = begin; i < end; ++i) n += split.is_left(from[i]);
  });
  for (std::size_t p = 0; p < pieces; ++p) lefts[p + 1] += lefts[p];
  std::vector<std::pair<Span4, Span4>> spans(pieces);
  pool.for_ranges(count, piece, [&](std::size_t begin, std::size_t end) {
    const std::size_t p = begin / piece;
    Reference *left = to + lefts[p], *right = to + split.left_count + (begin - lefts[p]);
    for (std::size_t i = begin; i < end; ++i) {
      const bool is_left = split.is_left(from[i]);
      (is_left ? spans[p].first : spans[p].second).add(from[i]);
      *(is_left ? left : right)++ = from[i];
    }
  });
  for (std::size_t p = 1; p < pieces; ++p) {
    spans[0].first.add(spans[p].first);
    spans[0].second.add(spans[p].second);
  }
  return spans[0];
}

}  // namespace nook
