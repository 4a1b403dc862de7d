// Every mask of 16 lanes against a loop over its bits, by the processor's instructions and without.
#include <gtest/gtest.h>

#include "support/kernels.hpp"

namespace nook::test {
namespace {

class LaneLists : public ::testing::TestWithParam<int> {};

TEST_P(LaneLists, AreTheMasksLanesInOrder) {
  const TestProgram program(test_kernel_source("probe_lanes.cl"),
                            BuildOptions().define("TRAVERSAL_PORTABLE", GetParam()));
  constexpr std::uint32_t masks = 1u << 16, room = 48, first = 0xfffffff0u, step = 32, before = 3;
  std::vector<std::uint32_t> out(masks * room);
  program.run("lanes_of_mask", masks, first, step, before, InOut<std::uint32_t>{out});
  for (std::uint32_t mask = 0; mask < masks; ++mask) {
    std::vector<std::uint32_t> expected(before, 7u);
    for (std::uint32_t lane = 0; lane < 16; ++lane)
      if (mask >> lane & 1u) expected.push_back(first + step * lane);
    const std::uint32_t* found = out.data() + room * mask;
    ASSERT_EQ(found[0], mask);
    ASSERT_EQ(found[1], expected.size() - before);
    ASSERT_EQ(std::vector<std::uint32_t>(found + 2, found + 2 + expected.size()), expected)
        << "mask " << mask;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, LaneLists, ::testing::Values(0, 1),
                         [](const auto& portable) { return portable.param ? "portable" : "native"; });

}  // namespace
}  // namespace nook::test
