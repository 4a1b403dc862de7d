#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "support/kernels.hpp"

namespace nook::test {
namespace {

// Ties and their neighbours, where a float loses its fraction, the largest there are, and bits at random.
std::vector<float> numbers_to_round() {
  std::vector<float> numbers;
  const auto add = [&](float x) {
    for (const float y : {x, std::nextafter(x, 0.0f), std::nextafter(x, INFINITY)})
      if (std::abs(y) < 0x1p63f) numbers.insert(numbers.end(), {y, -y});
  };
  for (int i = 0; i < 1000; ++i) add(float(i) + 0.5f), add(float(i));
  for (int bit = -149; bit < 64; ++bit)
    for (const float step : {0.0f, 0.5f, 1.0f, 1.5f}) add(std::ldexp(1.0f, bit) + step);
  std::mt19937 random(20260101);
  while (numbers.size() < 1000000) {
    const float x = std::bit_cast<float>(std::uint32_t(random()));
    if (std::abs(x) < 0x1p63f) numbers.push_back(x);
  }
  return numbers;
}

// Exactly: a float is a double, and llrint() rounds that to nearest, ties to even.
TEST(FixedPoint, IsTheNearestInteger) {
  const std::vector<float> numbers = numbers_to_round();
  std::vector<std::uint64_t> rounded(numbers.size());
  TestProgram(test_kernel_source("test_fixed_point.cl"), BuildOptions())
      .run("fixed_point_of", numbers.size(), numbers, InOut<std::uint64_t>{rounded});
  for (std::size_t i = 0; i < numbers.size(); ++i)
    ASSERT_EQ(std::int64_t(rounded[i]), std::llrint(double(numbers[i]))) << numbers[i];
}

}  // namespace
}  // namespace nook::test
