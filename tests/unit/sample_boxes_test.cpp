#include "film/sample_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace nook {
namespace {

using Cell = std::pair<std::uint32_t, std::uint32_t>;  // pixel, sample

std::set<Cell> cells_of(const SampleBoxes& boxes) {
  std::set<Cell> cells;
  for (const SampleBox& b : boxes)
    for (std::uint32_t p = b.pixel_begin; p < b.pixel_end; ++p)
      for (std::uint32_t s = b.first; s < b.end; ++s) cells.insert({p, s});
  return cells;
}

SampleBoxes random_boxes(std::minstd_rand& random, int count) {
  SampleBoxes boxes;
  for (int i = 0; i < count; ++i) {
    const auto p = std::uint32_t(random() % 12), s = std::uint32_t(random() % 12);
    boxes.push_back({p, p + std::uint32_t(random() % 6), s, s + std::uint32_t(random() % 6)});
  }
  return boxes;
}

// The same set of cells, each in one box alone.
void expect_partition(const SampleBoxes& boxes, const std::set<Cell>& cells) {
  EXPECT_EQ(cells_of(boxes), cells);
  EXPECT_EQ(samples_in(boxes), cells.size());
}

TEST(SampleBoxes, UnionAndDifferenceAreThoseOfTheCells) {
  std::minstd_rand random(1);
  for (int round = 0; round < 300; ++round) {
    const SampleBoxes a = random_boxes(random, 6), b = random_boxes(random, 4);
    const std::set<Cell> cells_a = cells_of(a), cells_b = cells_of(b);
    expect_partition(unite(a), cells_a);
    std::set<Cell> left;
    for (const Cell& cell : cells_a)
      if (!cells_b.count(cell)) left.insert(cell);
    expect_partition(subtract(a, b), left);
  }
}

TEST(SampleBoxes, UnionIsCanonical) {
  std::minstd_rand random(2);
  for (int round = 0; round < 300; ++round) {
    SampleBoxes a = random_boxes(random, 8);
    const SampleBoxes first = unite(a);
    std::shuffle(a.begin(), a.end(), random);
    EXPECT_EQ(unite(a), first);
    EXPECT_EQ(unite(first), first);
  }
  EXPECT_EQ(unite({{0, 4, 0, 2}, {4, 8, 0, 2}, {0, 8, 2, 5}}), (SampleBoxes{{0, 8, 0, 5}}));
}

TEST(SampleBoxes, OverlapIsFoundExactlyWhereThereIsOne) {
  std::minstd_rand random(3);
  for (int round = 0; round < 300; ++round) {
    const SampleBoxes a = random_boxes(random, 3);
    std::uint64_t samples = samples_in(a);
    std::optional<SampleBox> overlap;
    unite(a, &overlap);
    EXPECT_EQ(overlap.has_value(), samples > cells_of(a).size());
  }
}

TEST(SampleBoxes, ManyBoxesAreKeptFew) {
  HeldSamples held;
  for (std::uint32_t sample = 0; sample < 64; ++sample)
    for (std::uint32_t p = 0; p < 4096; p += 2) held.add({p, p + 2, sample, sample + 1});
  EXPECT_EQ(held.boxes(), (SampleBoxes{{0, 4096, 0, 64}}));
}

}  // namespace
}  // namespace nook
