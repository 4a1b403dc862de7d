// The denoiser on planes made by hand: what it must keep, and what it must take away.
#include "image/denoise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nook {
namespace {

constexpr int width = 40, height = 30;
constexpr std::size_t count = width * height;

// A floor on the left half and, from column `edge` on, another surface.
struct Surfaces {
  std::vector<float> n[3], x[3];
  Surfaces() {
    for (auto* planes : {n, x})
      for (int axis = 0; axis < 3; ++axis) planes[axis].assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      n[1][i] = 1;
      x[0][i] = float(i % width);
      x[2][i] = float(i / width);
    }
  }
  DenoiseGuides guides() const { return {width, height, {n[0], n[1], n[2]}, {x[0], x[1], x[2]}}; }
};

std::vector<float> noisy(float mean, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(mean, deviation);
  std::vector<float> values(count);
  for (float& value : values) value = std::clamp(normal(random), 0.0f, 1.0f);
  return values;
}

double rmse(const std::vector<float>& values, float expected) {
  double sum = 0;
  for (const float value : values) sum += (value - expected) * (value - expected);
  return std::sqrt(sum / double(values.size()));
}

TEST(Denoise, AConstantStaysToTheBit) {
  const Surfaces surfaces;
  for (const float value : {0.0f, 0.1f, 1.0f / 3, 0.7f, 1.0f}) {
    const std::vector<float> constant(count, value);
    EXPECT_EQ(denoise(surfaces.guides(), constant, std::vector<float>(count, 0.0f)), constant);
    EXPECT_EQ(denoise(surfaces.guides(), constant, std::vector<float>(count, 0.04f)), constant);
  }
}

// White noise of standard error 0.1 on one surface: five passes average over some thousand pixels, less what
// the weights by difference keep.
TEST(Denoise, NoiseOnOneSurfaceFalls) {
  const std::vector<float> values = noisy(0.5f, 0.1f, 3);
  const Surfaces surfaces;
  const auto filtered = denoise(surfaces.guides(), values, std::vector<float>(count, 0.01f));
  EXPECT_LT(rmse(filtered, 0.5f), 0.1 / 8);
}

TEST(Denoise, WithoutVarianceNothingMoves) {
  const std::vector<float> values = noisy(0.5f, 0.1f, 4);
  EXPECT_EQ(denoise(Surfaces().guides(), values, std::vector<float>(count, 0.0f)), values);
}

// Bounds of the input bound the output, whatever the planes hold.
TEST(Denoise, TheRangeNeverWidens) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (unsigned seed = 0; seed < 20; ++seed) {
    Surfaces surfaces;
    for (std::size_t i = 0; i < count; ++i) {
      const float a = uniform(random), b = uniform(random), length = std::sqrt(a * a + b * b + 1);
      surfaces.n[0][i] = a / length, surfaces.n[1][i] = 1 / length, surfaces.n[2][i] = b / length;
      surfaces.x[1][i] = uniform(random);
    }
    std::vector<float> values = noisy(0.5f, 0.5f, seed), variance = noisy(0.1f, 0.1f, seed + 100);
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    for (const float value : denoise(surfaces.guides(), values, variance)) {
      EXPECT_GE(value, *least);
      EXPECT_LE(value, *largest);
    }
  }
}

// A wall beside the floor, a floor forty units higher, and background: nothing passes between them.
TEST(Denoise, EdgesBetweenSurfacesAreKept) {
  for (int edge = 0; edge < 3; ++edge) {
    Surfaces surfaces;
    std::vector<float> values = noisy(0.2f, 0.05f, 6);
    const std::vector<float> right = noisy(0.8f, 0.05f, 7);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % width < width / 2) continue;
      values[i] = right[i];
      if (edge == 0) surfaces.n[0][i] = 1, surfaces.n[1][i] = 0;
      if (edge == 1) surfaces.x[1][i] = 40;
      if (edge == 2) surfaces.n[1][i] = 0;
    }
    // Far too large a variance: the guides alone must stop it.
    const auto filtered = denoise(surfaces.guides(), values, std::vector<float>(count, 4.0f));
    for (std::size_t i = 0; i < count; ++i) {
      if (i % width < width / 2)
        EXPECT_NEAR(filtered[i], 0.2f, 0.03f);
      else if (edge == 2)
        EXPECT_EQ(filtered[i], values[i]);
      else
        EXPECT_NEAR(filtered[i], 0.8f, 0.03f);
    }
  }
}

// A shadow's edge on one surface, ten standard errors high, stays an edge.
TEST(Denoise, StepsFarAboveTheNoiseAreKept) {
  const Surfaces surfaces;
  std::vector<float> values = noisy(0.25f, 0.05f, 8);
  const std::vector<float> right = noisy(0.75f, 0.05f, 9);
  for (std::size_t i = 0; i < count; ++i)
    if (i % width >= width / 2) values[i] = right[i];
  const auto filtered = denoise(surfaces.guides(), values, std::vector<float>(count, 0.0025f));
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_NEAR(filtered[i], i % width < width / 2 ? 0.25f : 0.75f, 0.1f) << i % width;
}

TEST(Denoise, ThreadsDoNotMatter) {
  const Surfaces surfaces;
  const std::vector<float> values = noisy(0.5f, 0.2f, 10), variance(count, 0.04f);
  DenoiseSettings one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(denoise(surfaces.guides(), values, variance, one),
            denoise(surfaces.guides(), values, variance, three));
}

}  // namespace
}  // namespace nook
