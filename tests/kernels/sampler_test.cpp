// The samplers' random numbers: the same bits on device and host, uniform for every sample count, and
// independent where they claim to be. How evenly the points lie is tested in point_set_test.cpp.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "support/kernels.hpp"
#include "support/samplers_on_host.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

const std::map<Sampler, std::string> all_samplers{{Sampler::independent, "independent"},
                                                  {Sampler::stratified, "stratified"},
                                                  {Sampler::halton, "halton"},
                                                  {Sampler::sobol, "sobol"},
                                                  {Sampler::zorder, "zorder"}};

EstimatorParams counts(std::uint32_t samples, std::uint32_t directions, std::uint32_t seed,
                       std::uint32_t width = 0) {
  EstimatorParams p{};
  p.samples = p.total_samples = samples;
  p.directions = p.total_directions = directions;
  p.seed = seed;
  p.width = width;
  return p;
}

bool same_bits(const vec2& a, const vec2& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(Sampler, DeviceAndHostDrawTheSameBits) {
  const std::uint32_t pixels = 300;
  for (const auto& [sampler, name] : all_samplers) {
    TestProgram program(test_kernel_source("test_sampler.cl"),
                        BuildOptions().define("SAMPLER", long(sampler)));
    for (auto [samples, directions] : {std::pair{1u, 1u}, {1u, 64u}, {16u, 1u}, {4u, 8u}, {3u, 5u}, {7u, 1u}})
      for (auto [seed, first_pixel] : {std::pair{0u, 0u}, {0xfeedfaceu, 479700u}}) {
        EstimatorParams p = counts(samples, directions, seed, 800);
        std::vector<vec2> positions(pixels * samples), points(pixels * samples * directions);
        program.run("draw", points.size(), p, first_pixel, InOut<vec2>{positions}, InOut<vec2>{points});
        // Backwards: the order of evaluation must not matter.
        for (std::uint32_t i = pixels * samples; i-- > 0;) {
          std::uint32_t pixel = first_pixel + i / samples, sample = i % samples;
          ASSERT_TRUE(same_bits(positions[i], host_sample_pixel(sampler, pixel, sample, p)))
              << name << " pixel " << pixel;
          for (std::uint32_t d = directions; d-- > 0;)
            ASSERT_TRUE(
                same_bits(points[i * directions + d], host_sample_direction(sampler, pixel, sample, d, p)))
                << name << " pixel " << pixel << " sample " << sample << " direction " << d;
        }
      }
  }
}

TEST(Sampler, OneCameraSampleLooksThroughThePixelCentre) {
  for (const auto& [sampler, name] : all_samplers)
    EXPECT_EQ(host_sample_pixel(sampler, 12345, 0, counts(1, 16, 3, 640)), vec2(0.5f)) << name;
}

// P-value that the points are uniform: chi-squared on 16 x 16 cells.
double uniform_p(const std::vector<vec2>& points) {
  std::vector<std::uint64_t> cells(256);
  for (const vec2& u : points) {
    if (!(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1)) return 0;
    ++cells[16 * int(u.x * 16) + int(u.y * 16)];
  }
  return uniform_counts_p(cells);
}

// An estimate with one fixed sample index is unbiased exactly if that sample is uniform over pixels (or
// seeds): for counts that stratify well and for those that do not. For zorder neighbours are dependent, so
// seeds vary.
TEST(Sampler, EverySampleIsUniformWhateverTheCount) {
  const std::uint32_t draws = long_mode() ? 1 << 20 : 1 << 15;
  const std::uint32_t seed = test_seed(77);
  std::vector<std::pair<std::string, double>> results;
  for (const auto& [sampler, name] : all_samplers)
    for (auto [samples, directions] :
         {std::pair{1u, 1u}, {1u, 7u}, {3u, 5u}, {4u, 16u}, {13u, 1u}, {1u, 100u}, {64u, 1u}})
      for (std::uint32_t index :
           std::set<std::uint32_t>{0, samples * directions / 2, samples * directions - 1}) {
        std::vector<vec2> points, positions;
        for (std::uint32_t i = 0; i < draws; ++i) {
          EstimatorParams p = counts(samples, directions, sampler == Sampler::zorder ? seed + i : seed, 256);
          points.push_back(host_sample_direction(sampler, i, index / directions, index % directions, p));
          positions.push_back(host_sample_pixel(sampler, i, index / directions, p));
        }
        std::string where = name + " " + std::to_string(samples) + "x" + std::to_string(directions) +
                            " sample " + std::to_string(index);
        results.emplace_back(where + ", direction", uniform_p(points));
        if (samples > 1) results.emplace_back(where + ", position", uniform_p(positions));
      }
  for (const auto& [where, p] : results) EXPECT_GT(p, sidak(1e-3, results.size())) << where;
}

// What an independent sampler promises: no relation between neighbours in any of its arguments. The pair (a,
// b) of single coordinates must be uniform on the square; chi-squared as above.
TEST(Sampler, IndependentNumbersAreIndependent) {
  const std::uint32_t draws = long_mode() ? 1 << 22 : 1 << 18;
  const Sampler sampler = Sampler::independent;
  const std::uint32_t seed = test_seed(99);
  EstimatorParams p = counts(64, 64, seed), next_seed = counts(64, 64, seed + 1);
  std::map<std::string, std::vector<vec2>> pairs;
  for (std::uint32_t i = 0; i < draws; ++i) {
    std::uint32_t pixel = i / 64, sample = i % 64, direction = i / 4096 % 64;
    vec2 u = host_sample_direction(sampler, pixel, sample, direction, p);
    vec2 pixel_on = host_sample_direction(sampler, pixel + 1, sample, direction, p);
    vec2 sample_on = host_sample_direction(sampler, pixel, sample + 1, direction, p);
    vec2 direction_on = host_sample_direction(sampler, pixel, sample, direction + 1, p);
    vec2 seed_on = host_sample_direction(sampler, pixel, sample, direction, next_seed);
    vec2 camera = host_sample_pixel(sampler, pixel, sample, p);
    pairs["u, v"].push_back(u);
    pairs["camera x, y"].push_back(camera);
    pairs["direction, camera"].push_back({u.x, camera.x});
    for (int axis : {0, 1}) {
      std::string a = axis ? "v" : "u";
      pairs["next pixel " + a].push_back({u[axis], pixel_on[axis]});
      pairs["next sample " + a].push_back({u[axis], sample_on[axis]});
      pairs["next direction " + a].push_back({u[axis], direction_on[axis]});
      pairs["next seed " + a].push_back({u[axis], seed_on[axis]});
    }
  }
  for (const auto& [what, points] : pairs) EXPECT_GT(uniform_p(points), sidak(1e-3, pairs.size())) << what;
}

// Different pixels of one image must not share point sets, or their errors would form patterns.
TEST(Sampler, PixelsHaveDifferentPoints) {
  for (const auto& [sampler, name] : all_samplers) {
    std::set<std::pair<float, float>> seen;
    for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
      vec2 u = host_sample_direction(sampler, pixel, 0, 0, counts(1, 4, 5, 200));
      seen.insert({u.x, u.y});
    }
    EXPECT_GT(seen.size(), 19995u) << name;  // 2^48 points: none coincide but by a defect
  }
}

TEST(Random, PermuteIsABijectionWithUniformImages) {
  std::vector<std::uint32_t> sizes{1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 16, 17, 31, 100, 1000, 65537};
  for (std::uint32_t n : sizes)
    for (std::uint32_t key : {0u, 1u, 0xdeadbeefu}) {
      std::set<std::uint32_t> images;
      for (std::uint32_t i = 0; i < n; ++i) images.insert(host_permute(i, n, key));
      ASSERT_EQ(images.size(), n);
      ASSERT_LT(*images.rbegin(), n);
    }
  // Over keys: image of one element, and the ordered pair of images of two.
  for (std::uint32_t n : {3u, 5u, 7u, 12u}) {
    std::vector<std::uint64_t> single(n), pair(n * (n - 1));
    for (std::uint32_t key = 0; key < 60000; ++key) {
      std::uint32_t a = host_permute(1, n, key), b = host_permute(2, n, key);
      ++single[a];
      ++pair[a * (n - 1) + (b > a ? b - 1 : b)];
    }
    EXPECT_GT(uniform_counts_p(single), 1e-4) << n;
    EXPECT_GT(uniform_counts_p(pair), 1e-4) << n;
  }
}

}  // namespace
}  // namespace nook::test
