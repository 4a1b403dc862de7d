// How evenly the samplers' points lie: each claim of sampler.cl as a count of points in boxes.
#include <gtest/gtest.h>

#include <cmath>

#include "support/samplers_on_host.hpp"

namespace nook::test {
namespace {

EstimatorParams counts(std::uint32_t samples, std::uint32_t directions, std::uint32_t width = 0) {
  EstimatorParams p{};
  p.samples = p.total_samples = samples;
  p.directions = p.total_directions = directions;
  p.seed = 4;
  p.width = width;
  return p;
}

std::vector<vec2> directions_of(Sampler sampler, std::uint32_t pixel, const EstimatorParams& p,
                                std::uint32_t first_sample = 0, std::uint32_t samples = 0) {
  std::vector<vec2> points;
  for (std::uint32_t s = first_sample; s < first_sample + (samples ? samples : p.total_samples); ++s)
    for (std::uint32_t d = 0; d < p.total_directions; ++d)
      points.push_back(host_sample_direction(sampler, pixel, s, d, p));
  return points;
}

// True if each box of a columns x rows grid holds as many points as any other.
bool even(const std::vector<vec2>& points, std::size_t columns, std::size_t rows) {
  std::vector<std::size_t> boxes(columns * rows);
  for (const vec2& u : points)
    ++boxes[std::size_t(double(u.x) * double(columns)) * rows + std::size_t(double(u.y) * double(rows))];
  for (std::size_t box : boxes)
    if (box * boxes.size() != points.size()) return false;
  return true;
}

// A (0,m,2)-net in base 2: every elementary interval of area 1/N holds one point.
bool is_net(const std::vector<vec2>& points) {
  for (std::size_t columns = 1; columns <= points.size(); columns *= 2)
    if (!even(points, columns, points.size() / columns)) return false;
  return true;
}

TEST(PointSet, SobolDirectionsAreNets) {
  for (std::uint32_t pixel : {0u, 1u, 2u, 480000u})
    for (std::uint32_t n = 1; n <= 1024; n *= 2) {
      EXPECT_TRUE(is_net(directions_of(Sampler::sobol, pixel, counts(1, n)))) << n;
      EXPECT_TRUE(is_net(directions_of(Sampler::sobol, pixel, counts(n, 1)))) << n;
    }
}

TEST(PointSet, SobolSplitsIntoNets) {
  for (std::uint32_t pixel : {5u, 77777u}) {
    EstimatorParams p = counts(16, 32);
    EXPECT_TRUE(is_net(directions_of(Sampler::sobol, pixel, p)));
    for (std::uint32_t s = 0; s < 16; ++s) EXPECT_TRUE(is_net(directions_of(Sampler::sobol, pixel, p, s, 1)));
    for (std::uint32_t s = 0; s < 16; s += 4)
      EXPECT_TRUE(is_net(directions_of(Sampler::sobol, pixel, p, s, 4)));
  }
}

// Joe and Kuo's dimensions 3 and 4 make with the first two a (t,m,4)-net whose t is at most the sum of
// (degree - 1) of their polynomials, 0 + 0 + 1 + 2 = 3 (Niederreiter 1987): each elementary interval of
// volume 2^(3-m) holds 8 points.
TEST(PointSet, SobolIsJointlyStratifiedOverPixelAndDirection) {
  const int m = 10;
  EstimatorParams p = counts(1u << m, 1);
  std::vector<std::array<float, 4>> points;
  for (std::uint32_t s = 0; s < p.total_samples; ++s) {
    vec2 direction = host_sample_direction(Sampler::sobol, 9, s, 0, p),
         position = host_sample_pixel(Sampler::sobol, 9, s, p);
    points.push_back({direction.x, direction.y, position.x, position.y});
  }
  for (int a = 0; a <= m - 3; ++a)
    for (int b = 0; a + b <= m - 3; ++b)
      for (int c = 0; a + b + c <= m - 3; ++c) {
        const int bits[4] = {a, b, c, m - 3 - a - b - c};
        std::vector<int> boxes(1u << (m - 3));
        for (const auto& x : points) {
          unsigned box = 0;
          for (int k = 0; k < 4; ++k) box = box << bits[k] | unsigned(std::ldexp(x[k], bits[k]));
          ++boxes[box];
        }
        for (int box : boxes) ASSERT_EQ(box, 8) << a << b << c;
      }
}

// The direction numbers from their definition: m_k of the primitive polynomial x^s + a_1 x^(s-1) + ... + 1 by
// the recurrence of Bratley and Fox 1988.
TEST(PointSet, SobolDirectionNumbersFollowFromTheirPolynomials) {
  struct Polynomial {
    unsigned degree, inner;  // inner: bits a_1 ... a_(s-1)
    std::vector<std::uint32_t> m;
  };
  const Polynomial polynomials[] = {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
  for (unsigned k = 0; k < 32; ++k) EXPECT_EQ(host_sobol(1u << k, 0), 1u << (31 - k));
  for (unsigned dimension = 1; dimension <= 3; ++dimension) {
    const Polynomial& q = polynomials[dimension - 1];
    std::vector<std::uint32_t> v;
    for (unsigned k = 0; k < 32; ++k) {
      if (k < q.degree) {
        v.push_back(q.m[k] << (31 - k));
      } else {
        std::uint32_t next = v[k - q.degree] ^ v[k - q.degree] >> q.degree;
        for (unsigned j = 1; j < q.degree; ++j)
          if (q.inner >> (q.degree - 1 - j) & 1) next ^= v[k - j];
        v.push_back(next);
      }
      EXPECT_EQ(host_sobol(1u << k, dimension), v[k]) << "dimension " << dimension << " bit " << k;
    }
    EXPECT_EQ(host_sobol(0xb5u, dimension), v[0] ^ v[2] ^ v[4] ^ v[5] ^ v[7]);
  }
}

TEST(PointSet, StratifiedFillsItsCells) {
  for (std::uint32_t pixel : {0u, 3u, 1000u}) {
    EXPECT_TRUE(even(directions_of(Sampler::stratified, pixel, counts(1, 64)), 8, 8));
    EXPECT_TRUE(even(directions_of(Sampler::stratified, pixel, counts(1, 49)), 7, 7));
    EXPECT_TRUE(even(directions_of(Sampler::stratified, pixel, counts(8, 2)), 4, 4));
    EXPECT_TRUE(even(directions_of(Sampler::stratified, pixel, counts(1, 12)), 3, 4));
    for (std::uint32_t n : {1u, 2u, 3u, 5u, 7u, 11u, 13u, 16u, 100u, 1000u})
      EXPECT_TRUE(even(directions_of(Sampler::stratified, pixel, counts(1, n)), 1, n))
          << n;  // strips, whatever n
  }
}

TEST(PointSet, HaltonFillsItsBoxes) {
  for (std::uint32_t pixel : {0u, 3u, 1000u}) {
    EXPECT_TRUE(even(directions_of(Sampler::halton, pixel, counts(1, 64)), 64, 1));
    EXPECT_TRUE(even(directions_of(Sampler::halton, pixel, counts(1, 81)), 1, 81));
    EXPECT_TRUE(even(directions_of(Sampler::halton, pixel, counts(6, 6)), 4, 9));
    EXPECT_TRUE(even(directions_of(Sampler::halton, pixel, counts(1, 216)), 8, 27));
    EstimatorParams p = counts(35, 1);
    std::vector<vec2> positions;
    for (std::uint32_t s = 0; s < 35; ++s)
      positions.push_back(host_sample_pixel(Sampler::halton, pixel, s, p));
    EXPECT_TRUE(even(positions, 5, 7));
  }
}

// Aligned blocks of 2^k x 2^k pixels share one net: what one pixel misses, its neighbours have.
TEST(PointSet, ZorderNeighboursCompleteEachOther) {
  const std::uint32_t width = 64;
  for (std::uint32_t n : {1u, 4u, 16u})
    for (std::uint32_t block : {2u, 4u, 8u})
      for (std::uint32_t corner : {0u, 8u, 8u * width + 16u}) {
        std::vector<vec2> points;
        for (std::uint32_t y = 0; y < block; ++y)
          for (std::uint32_t x = 0; x < block; ++x)
            for (vec2 u : directions_of(Sampler::zorder, corner + y * width + x, counts(1, n, width)))
              points.push_back(u);
        EXPECT_TRUE(is_net(points)) << n << " points a pixel, block " << block;
      }
  EXPECT_TRUE(is_net(directions_of(Sampler::zorder, 70000u * 3u, counts(4, 16, 70000u))));
}

// With 5 points of a block of 8, pixels must not all leave out the same eighths: over an image each is
// equally full.
TEST(PointSet, ZorderCoversTheSquareForAnyCount) {
  std::vector<std::size_t> eighths(8);
  for (std::uint32_t pixel = 0; pixel < 4096; ++pixel)
    for (vec2 u : directions_of(Sampler::zorder, pixel, counts(1, 5, 64))) ++eighths[std::size_t(u.x * 8)];
  for (std::size_t count : eighths)
    EXPECT_NEAR(double(count), 4096 * 5 / 8, 200);  // 4 sigma of independent points: 188
}

}  // namespace
}  // namespace nook::test
