// Faces are cut into triangles that cover their outline exactly: areas against exact ones, in integers.
#include "mesh/face_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>

#include "mesh/orientation.hpp"
#include "mesh/outline_crossing.hpp"
#include "mesh/star_outline.hpp"

namespace nook {
namespace {

using Outline = std::vector<glm::i64vec2>;
using Place = std::function<dvec3(const glm::i64vec2&)>;

std::int64_t cross(const glm::i64vec2& a, const glm::i64vec2& b, const glm::i64vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::int64_t twice_area(const Outline& outline) {
  std::int64_t sum = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) sum += cross(outline[0], outline[i], outline[i + 1]);
  return sum;
}

Place flat() {
  return [](const glm::i64vec2& p) { return dvec3(double(p.x), double(p.y), 0); };
}

// n - 2 triangles, none turned over, whose areas add up to the outline's: they cover it, each part once.
void expect_covered(const Outline& outline, const Place& place = flat()) {
  std::vector<dvec3> corners;
  for (const glm::i64vec2& p : outline) corners.push_back(place(p));
  std::vector<FaceCutter::Triangle> triangles;
  EXPECT_TRUE(FaceCutter().cut(corners, triangles));
  ASSERT_EQ(triangles.size(), outline.size() - 2);
  std::int64_t sum = 0;
  for (const FaceCutter::Triangle& t : triangles) {
    const std::int64_t area = cross(outline[t[0]], outline[t[1]], outline[t[2]]);
    EXPECT_GE(area, 0);
    sum += area;
  }
  EXPECT_EQ(sum, twice_area(outline));
}

// Turned, scaled and moved; what is left of the outline's exactness is up to the rounding of doubles.
Place somewhere(std::mt19937& random, double scale, double distance) {
  std::normal_distribution<double> normal;
  const dvec3 axis = glm::normalize(dvec3(normal(random), normal(random), normal(random)));
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), normal(random) * 3, axis);
  const dvec3 at = distance * dvec3(normal(random), normal(random), normal(random));
  return [=](const glm::i64vec2& p) {
    return at + scale * dvec3(turn * glm::dvec4(double(p.x), double(p.y), 0, 1));
  };
}

Outline turned_to(Outline outline, std::size_t first) {
  std::rotate(outline.begin(), outline.begin() + std::ptrdiff_t(first), outline.end());
  return outline;
}

const Outline letter_e = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 2}, {3, 2},
                          {3, 3}, {1, 3}, {1, 4}, {4, 4}, {4, 5}, {0, 5}};
const Outline plus = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                      {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
const Outline dart = {{0, 0}, {6, 6}, {0, 3}, {-6, 6}};
// A wall with a window: the outline goes to it and back along one edge.
const Outline window = {{0, 0}, {10, 0}, {10, 8}, {0, 8}, {0, 0}, {3, 3}, {3, 5}, {7, 5}, {7, 3}, {3, 3}};

const Outline two_windows = {{0, 0}, {20, 0}, {20, 9}, {0, 9}, {0, 0}, {2, 2},  {2, 6},  {6, 6},
                             {6, 2}, {2, 2},  {0, 0},  {9, 2}, {9, 5}, {13, 5}, {13, 2}, {9, 2}};

TEST(FaceCut, LettersArrowsAndWindowsFromEveryCornerAnywhere) {
  std::mt19937 random(1);
  for (const Outline& outline : {letter_e, plus, dart, window, two_windows})
    for (std::size_t first = 0; first < outline.size(); ++first) {
      SCOPED_TRACE(testing::Message() << outline.size() << " corners from " << first);
      expect_covered(turned_to(outline, first));
      for (const double scale : {1e-30, 1e-3, 1.0, 1e6, 1e30})
        for (int i = 0; i < 5; ++i) expect_covered(turned_to(outline, first), somewhere(random, scale, 0));
      for (const double distance : {1e3, 1e6, 1e9})
        expect_covered(turned_to(outline, first), somewhere(random, 1, distance));
    }
}

// Simple outlines by 2-opt: crossing edges of a random closed path are untangled until none is left.
Outline random_outline(std::mt19937& random, int corners, int extent) {
  std::uniform_int_distribution<int> upto(0, extent);
  for (;;) {
    Outline p;
    while (int(p.size()) < corners) {
      const glm::i64vec2 q(upto(random), upto(random));
      if (std::find(p.begin(), p.end(), q) == p.end()) p.push_back(q);
    }
    const auto meet = [&](std::size_t i, std::size_t j) {
      const auto &a = p[i], &b = p[(i + 1) % p.size()], &c = p[j], &d = p[(j + 1) % p.size()];
      const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
      return sign(cross(a, b, c)) * sign(cross(a, b, d)) <= 0 &&
             sign(cross(c, d, a)) * sign(cross(c, d, b)) <= 0;
    };
    bool changed = true, good = true;
    for (int round = 0; changed && round < 200; ++round) {
      changed = false;
      for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = i + 2; j < p.size() - (i == 0); ++j)
          if (meet(i, j)) {
            std::reverse(p.begin() + std::ptrdiff_t(i + 1), p.begin() + std::ptrdiff_t(j + 1));
            changed = true;
          }
    }
    for (std::size_t i = 0; i < p.size() && good; ++i)
      for (std::size_t j = i + 2; j < p.size() - (i == 0) && good; ++j) good = !meet(i, j);
    for (std::size_t i = 0; i < p.size() && good; ++i)  // no edge turns back over the one before it
      good = cross(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) != 0 ||
             glm::dot(glm::dvec2(p[(i + 1) % p.size()] - p[i]),
                      glm::dvec2(p[(i + 2) % p.size()] - p[(i + 1) % p.size()])) > 0;
    if (!good || twice_area(p) == 0) continue;
    if (twice_area(p) < 0) std::reverse(p.begin(), p.end());
    return p;
  }
}

TEST(FaceCut, RandomOutlinesAreCoveredExactly) {
  std::mt19937 random(2);
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const int corners = 4 + i % 30;
    // on a small grid many corners lie on one line
    const Outline outline = random_outline(random, corners, i % 2 ? 2 * corners : 1 << 20);
    expect_covered(outline);
    expect_covered(outline, somewhere(random, 1, 0));
  }
}

// A rectangle with holes that touch neither each other nor it, joined to it as programs do: from the hole's
// leftmost corner straight to a corner that can be seen from there.
TEST(FaceCut, HolesLeaveTheirAreaOut) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const int columns = 1 + i % 4, rows = 1 + i % 3;
    std::uniform_int_distribution<int> inside(1, 8);
    Outline outline = {{0, 0}};
    // each hole hangs on a corner of the bottom edge below it, or of the hole below it in its column
    std::int64_t holes = 0;
    for (int column = 0; column < columns; ++column) {
      const std::int64_t x = 10 * column;
      Outline path;  // up the column, around its holes from the last one, and back
      std::vector<Outline> rings;
      for (int row = 0; row < rows; ++row) {
        const std::int64_t y = 10 * row + 1, w = inside(random), h = inside(random);
        rings.push_back({{x + 1, y}, {x + 1, y + h}, {x + 1 + w, y + h}, {x + 1 + w, y}});
        holes += 2 * w * h;
      }
      path.push_back({x + 1, 0});
      for (int row = 0; row < rows; ++row) {
        path.push_back(rings[std::size_t(row)][0]);
        if (row + 1 < rows) path.push_back(rings[std::size_t(row)][1]);
      }
      for (int row = rows - 1; row >= 0; --row) {
        const Outline& ring = rings[std::size_t(row)];
        if (row + 1 == rows) path.push_back(ring[1]);
        path.insert(path.end(), {ring[1], ring[2], ring[3], ring[0]});
      }
      path.push_back({x + 1, 0});
      path.erase(std::unique(path.begin(), path.end()), path.end());
      outline.insert(outline.end(), path.begin(), path.end());
    }
    outline.insert(outline.end(), {{10 * columns, 0}, {10 * columns, 10 * rows}, {0, 10 * rows}});
    ASSERT_EQ(twice_area(outline), 200 * columns * rows - holes);
    for (std::size_t first : {std::size_t(0), outline.size() / 3, outline.size() / 2}) {
      expect_covered(turned_to(outline, first));
      expect_covered(turned_to(outline, first), somewhere(random, 1, 100));
    }
  }
}

TEST(FaceCut, ConvexFacesStayFansFromTheFirstCorner) {
  std::vector<dvec3> corners;
  for (int k = 0; k < 9; ++k)
    corners.emplace_back(3 * std::cos(.698 * k), std::sin(.698 * k), std::cos(.698 * k));
  std::vector<FaceCutter::Triangle> triangles;
  EXPECT_TRUE(FaceCutter().cut(corners, triangles));
  for (std::uint32_t k = 1; k + 1 < 9; ++k) EXPECT_EQ(triangles[k - 1], (FaceCutter::Triangle{0, k, k + 1}));
}

// A bow tie, a five-pointed star drawn in one go, a figure of eight whose halves balance.
TEST(FaceCut, OutlinesThatCrossAreSaidTo) {
  const Outline crossing[] = {{{0, 0}, {4, 4}, {4, 0}, {0, 5}},
                              {{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}},
                              {{0, 0}, {4, 4}, {4, 0}, {0, 4}},
                              {{0, 0}, {2, 0}, {4, 4}, {8, 4}, {8, 0}, {6, 0}, {0, 4}, {-2, 2}}};
  for (const Outline& outline : crossing) {
    std::vector<dvec3> corners;
    for (const glm::i64vec2& p : outline) corners.emplace_back(p.x, p.y, 2 * p.x);
    std::vector<FaceCutter::Triangle> triangles;
    EXPECT_FALSE(FaceCutter().cut(corners, triangles)) << outline[1].x;
    EXPECT_EQ(triangles.size(), outline.size() - 2);
  }
}

// Corners that lie on one line, at one place, or twice at the same place after another.
TEST(FaceCut, FacesWithoutAreaAreNoTrouble) {
  const Outline faces[] = {{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 1}},
                           {{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}},
                           {{0, 0}, {1, 0}, {1, 0}, {1, 0}, {0, 0}},
                           {{0, 0}, {4, 0}, {4, 0}, {4, 4}, {2, 1}, {2, 1}, {0, 4}}};
  for (const Outline& outline : faces) expect_covered(outline);
}

// A face that is not flat covers, seen from its front, what its outline does.
TEST(FaceCut, FacesThatAreNotFlat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> bump(-.3, .3);
  for (int i = 0; i < 50; ++i)
    expect_covered(letter_e,
                   [&](const glm::i64vec2& p) { return dvec3(bump(random), double(p.x), double(p.y)); });
}

TEST(FaceCut, OrientationIsExact) {
  // a line of slope 1 at 2^24, and a point one unit in the last place off it
  const dvec2 a(0.5, 0.5), b(12, 12);
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      const dvec2 c(24 + i * 0x1p-48, 24 + j * 0x1p-48);
      EXPECT_EQ(orientation(a, b, c), (j > i) - (j < i)) << i << ' ' << j;
      EXPECT_EQ(orientation(b, c, a), (j > i) - (j < i)) << i << ' ' << j;
    }
  EXPECT_EQ(orientation({1e-30, 1e-30}, {2e-30, 2e-30}, {3e-30, 3.0000000000000004e-30}), 1);
  EXPECT_EQ(orientation({0, 0}, {1e30, 1e30}, {1, 1}), 0);
}

// Against 128-bit integers, for points that are next to a line, on it by rounding, or anywhere.
TEST(FaceCut, OrientationIsThatOfIntegers) {
  std::mt19937_64 random(9);
  const auto coordinate = [&](int bits) {
    return std::int64_t(random() >> (64 - bits)) - (std::int64_t(1) << (bits - 1));
  };
  int undecided = 0;
  for (int i = 0; i < 100000; ++i) {
    const int bits = 3 + i % 50;
    const glm::i64vec2 a(coordinate(bits), coordinate(bits)), b(coordinate(bits), coordinate(bits));
    const double t = double(random() % 1000) / 500 - .5;
    const dvec2 near = dvec2(a) + t * (dvec2(b) - dvec2(a));
    const glm::i64vec2 c(std::llround(near.x) + std::int64_t(random() % 3) - 1, std::llround(near.y));
    const __int128 determinant = __int128(a.x - c.x) * (b.y - c.y) - __int128(a.y - c.y) * (b.x - c.x);
    ASSERT_EQ(orientation(dvec2(a), dvec2(b), dvec2(c)), (determinant > 0) - (determinant < 0)) << i;
    undecided += std::abs(double(determinant)) < 1e-15 * std::abs(double(a.x - c.x) * double(b.y - c.y));
  }
  EXPECT_GT(undecided, 1000) << "of them many must be beyond plain doubles";
}

Outline random_star(std::mt19937& random, int corners, double least) {
  std::uniform_real_distribution<double> radius(least, 1);
  Outline star;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners, r = radius(random);
    star.push_back({std::llround(1e9 * r * std::cos(angle)), std::llround(1e9 * r * std::sin(angle))});
  }
  return star;
}

TEST(FaceCut, StarsAreSeenFromOnePointAndCoveredExactly) {
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Outline star = random_star(random, 5 + 5 * (i % 40), i % 3 ? .3 : .02);
    expect_covered(star);
    expect_covered(star, somewhere(random, 1e-9, 10));
    std::vector<dvec2> seen(star.begin(), star.end());
    EXPECT_TRUE(star_centre(seen).has_value());
    EXPECT_FALSE(outline_crosses(seen));
    std::reverse(seen.begin(), seen.end());
    EXPECT_FALSE(star_centre(seen).has_value());
  }
  // round twice, of no kernel, and of a kernel that is a line
  const Outline pentagram = {{951, 309}, {-951, 309}, {588, -809}, {0, 1000}, {-588, -809}};
  for (const Outline& outline : {pentagram, letter_e, window, Outline{{0, 0}, {4, 0}, {2, 0}, {2, 2}}})
    EXPECT_FALSE(star_centre(std::vector<dvec2>(outline.begin(), outline.end())).has_value());
}

double seconds_for(const Outline& outline) {
  std::vector<dvec3> corners;
  for (const glm::i64vec2& p : outline) corners.emplace_back(double(p.x), double(p.y), double(p.x));
  std::vector<FaceCutter::Triangle> triangles;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(FaceCutter().cut(corners, triangles));
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::int64_t sum = 0;
  for (const FaceCutter::Triangle& t : triangles) sum += cross(outline[t[0]], outline[t[1]], outline[t[2]]);
  EXPECT_EQ(sum, twice_area(outline));
  return taken;
}

// Combs, a spiral, a star and a coast of 100 000 corners: far from the hours that n^2 steps would take.
TEST(FaceCut, LargeFacesTakeNoSquareOfTheirCorners) {
  constexpr std::int64_t n = 50000;
  Outline comb, sideways, spiral, star, coast;
  for (std::int64_t i = 0; i < n; ++i) {
    comb.push_back({4 * i, 100 + i % 7});
    comb.push_back({4 * i + 2, 100000 - i % 5});
  }
  comb.insert(comb.end(), {{4 * n, 100}, {4 * n, 0}, {0, 0}});
  std::reverse(comb.begin(), comb.end());
  for (const glm::i64vec2& p : comb) sideways.push_back({p.y, p.x});
  std::reverse(sideways.begin(), sideways.end());
  const auto at = [](double angle, double radius) {
    return glm::i64vec2(std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle)));
  };
  for (std::int64_t i = 0; i < n; ++i) spiral.push_back(at(2e-3 * double(i), 1e5 + 1e3 * double(i)));
  for (std::int64_t i = n; i-- > 0;) spiral.push_back(at(2e-3 * double(i), 1e6 + 1e3 * double(i)));
  for (std::int64_t i = 0; i < 2 * n; ++i)
    star.push_back(at(M_PI * double(i) / double(n), i % 2 ? 1e8 : 2e8));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(5e7, 1e8);
  for (std::int64_t i = 0; i < 2 * n; ++i) coast.push_back(at(M_PI * double(i) / double(n), radius(random)));
  for (Outline* outline : {&comb, &sideways, &spiral, &star, &coast}) {
    if (twice_area(*outline) < 0) std::reverse(outline->begin(), outline->end());
    const double taken = seconds_for(*outline);
    EXPECT_LT(taken, 10);
    RecordProperty("seconds_" + std::to_string(outline->size()), std::to_string(taken));
    std::printf("%zu corners: %.3f s\n", outline->size(), taken);
  }
}

}  // namespace
}  // namespace nook
