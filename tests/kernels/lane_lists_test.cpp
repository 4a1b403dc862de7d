// Every mask of a node's lanes against a loop over its bits, by the processor's instructions and without.
#include <gtest/gtest.h>

#include "support/kernels.hpp"

namespace nook::test {
namespace {

struct Path {
  const char* name;
  std::uint32_t width;
  bool portable = false, avx512 = true;
};
void PrintTo(const Path& path, std::ostream* out) {
  *out << path.name;
}

class LaneLists : public ::testing::TestWithParam<Path> {};

TEST_P(LaneLists, AreTheMasksLanesInOrder) {
  const Path& path = GetParam();
  const std::string source = test_kernel_source("test_lanes.cl");
  const TestProgram program(
      path.avx512 ? source : without_avx512(source),
      BuildOptions().define("TRAVERSAL_PORTABLE", path.portable).define("BVH_WIDTH", path.width));
  constexpr std::uint32_t room = 48, first = 0xfffffff0u, step = 32, before = 3;
  const std::uint32_t masks = 1u << path.width;
  std::vector<std::uint32_t> out(masks * room);
  program.run("lanes_of_mask", masks, first, step, before, InOut<std::uint32_t>{out});
  for (std::uint32_t mask = 0; mask < masks; ++mask) {
    std::vector<std::uint32_t> expected(before, 7u);
    for (std::uint32_t lane = 0; lane < path.width; ++lane)
      if (mask >> lane & 1u) expected.push_back(first + step * lane);
    const std::uint32_t* found = out.data() + room * mask;
    ASSERT_EQ(found[0], mask);
    ASSERT_EQ(found[1], expected.size() - before);
    ASSERT_EQ(std::vector<std::uint32_t>(found + 2, found + 2 + expected.size()), expected)
        << "mask " << mask;
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, LaneLists,
                         ::testing::Values(Path{"native", 16}, Path{"portable", 16, true},
                                           Path{"native_of_8", 8}, Path{"portable_of_8", 8, true},
                                           Path{"without_avx512_of_8", 8, false, false}),
                         [](const auto& path) { return std::string(path.param.name); });

}  // namespace
}  // namespace nook::test
