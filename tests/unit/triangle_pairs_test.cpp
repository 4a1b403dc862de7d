// Which triangles share a place of a leaf, and the corners' order that lets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include "bvh/bvh.hpp"
#include "bvh/triangle_pairs.hpp"
#include "mesh/corner_order.hpp"
#include "support/meshes.hpp"

namespace nook {
namespace {

/// A height field of n x n squares, each two triangles, as a loader leaves it.
TriangleMesh surface(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.positions.emplace_back(float(i), 0.3f * std::sin(0.7f * float(i) + 0.4f * float(j)), float(j));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({b, a + 1, b + 1});
    }
  end_with_longest_edges(mesh);
  return mesh;
}

std::vector<TrianglePair> pairs_of(const TriangleMesh& mesh, unsigned threads = 1) {
  TaskPool pool(threads);
  return pair_triangles(mesh, pool);
}

std::size_t full(const std::vector<TrianglePair>& pairs) {
  return std::size_t(
      std::count_if(pairs.begin(), pairs.end(), [](const TrianglePair& p) { return p.second != BVH_EMPTY; }));
}

void expect_each_once(const TriangleMesh& mesh, const std::vector<TrianglePair>& pairs) {
  std::vector<unsigned> seen(mesh.triangles.size());
  for (const TrianglePair& p : pairs) {
    ++seen.at(p.first);
    if (p.second == BVH_EMPTY) continue;
    ++seen.at(p.second);
    EXPECT_LT(p.first, p.second);
    EXPECT_EQ(mesh.positions[mesh.triangles[p.first][0]], mesh.positions[mesh.triangles[p.second][2]]);
    EXPECT_EQ(mesh.positions[mesh.triangles[p.first][2]], mesh.positions[mesh.triangles[p.second][0]]);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1u), std::ptrdiff_t(seen.size()));
}

TEST(TrianglePairs, AreTheHalvesOfASurfacesSquares) {
  const TriangleMesh mesh = surface(40);
  const std::vector<TrianglePair> pairs = pairs_of(mesh);
  EXPECT_EQ(pairs.size(), 1600u);
  expect_each_once(mesh, pairs);
}

TEST(TrianglePairs, AreFoundInAnyOrderOfTheTriangles) {
  TriangleMesh mesh = surface(200);  // more than a task's triangles: most partners are another task's
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(3));
  const std::vector<TrianglePair> pairs = pairs_of(mesh);
  EXPECT_EQ(pairs.size(), 40000u);
  expect_each_once(mesh, pairs);
}

TEST(TrianglePairs, DoNotDependOnTheThreads) {
  TriangleMesh mesh = surface(200);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(4));
  const std::vector<TrianglePair> one = pairs_of(mesh);
  for (const unsigned threads : {2u, 5u}) {
    const std::vector<TrianglePair> many = pairs_of(mesh, threads);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].first, many[i].first);
      ASSERT_EQ(one[i].second, many[i].second);
    }
  }
}

TEST(TrianglePairs, AreFoundByPlaceWhereEachTriangleHasVerticesOfItsOwn) {
  TriangleMesh mesh;
  test::add_square(mesh, {0, 0, 0}, {1, 0, 0}, {1, 1, -0.0f}, {0, 1, 0});
  mesh.positions[4].z = 0.0f;  // the second triangle's: equal, with other bits
  end_with_longest_edges(mesh);
  EXPECT_EQ(pairs_of(mesh).size(), 1u);
  mesh.positions[4].z = 1e-20f;
  EXPECT_EQ(pairs_of(mesh).size(), 2u);
}

// Three sheets that meet at an edge, and a triangle twice: each has one partner at most.
TEST(TrianglePairs, HaveTwoTrianglesWhateverMeetsAtAnEdge) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}};
  mesh.triangles = {{1, 2, 0}, {0, 3, 1}, {1, 4, 0}, {0, 5, 1}, {1, 2, 0}};
  const std::vector<TrianglePair> pairs = pairs_of(mesh);
  EXPECT_EQ(full(pairs), 2u);
  expect_each_once(mesh, pairs);
}

// A fan of sheets about one edge: looking through all of them for each would take minutes.
TEST(TrianglePairs, AreGivenUpWhereThousandsMeetAtAnEdge) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 9}};
  const std::uint32_t sheets = 400000;
  for (std::uint32_t i = 0; i < sheets; ++i) {
    const float angle = 6.2831853f * float(i) / float(sheets);
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 4.0f);
    mesh.triangles.push_back({0, i + 2, 1});
  }
  const auto start = std::chrono::steady_clock::now();
  expect_each_once(mesh, pairs_of(mesh));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

// Folded until the box of both is larger than their two boxes: apart they are cheaper.
TEST(TrianglePairs, AreNotMadeWhereTheBoxWouldGrow) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 1}, {5, 0, 0}, {0, 5, 0}};
  mesh.triangles = {{1, 2, 0}, {0, 3, 1}};
  EXPECT_EQ(full(pairs_of(mesh)), 0u);
  mesh.positions[3] = {0, 0.5f, 0.5f};
  EXPECT_EQ(full(pairs_of(mesh)), 1u);
}

TEST(TrianglePairs, LeaveOutWhatNoRayMeets) {
  TriangleMesh mesh = surface(2);
  mesh.positions[0].y = std::nanf("");
  const std::vector<TrianglePair> pairs = pairs_of(mesh);
  std::size_t triangles = 0;
  for (const TrianglePair& p : pairs) triangles += p.second == BVH_EMPTY ? 1 : 2;
  EXPECT_EQ(triangles, 7u);
}

TEST(TrianglePairs, MakeTheTreeOfASurfaceSmaller) {
  const TriangleMesh paired = surface(100);
  TriangleMesh turned = paired;  // one of each pair: no last edge is another's
  for (std::size_t i = 0; i < turned.triangles.size(); i += 2)
    std::rotate(turned.triangles[i].begin(), turned.triangles[i].begin() + 1, turned.triangles[i].end());
  EXPECT_EQ(full(pairs_of(turned)), 0u);
  EXPECT_LT(double(build_bvh(paired).bytes()), 0.7 * double(build_bvh(turned).bytes()));
}

TEST(CornerOrder, KeepsTheWindingAndTurnsAllOfACornersIndices) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};
  mesh.triangle_normals = {{10, 11, 12}, {12, 10, 11}, {11, 12, 10}};
  mesh.triangle_uvs = {{20, 21, 22}, {22, 20, 21}, {21, 22, 20}};
  end_with_longest_edges(mesh);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.triangles[i], (std::array<std::uint32_t, 3>{2, 0, 1}));
    EXPECT_EQ(mesh.triangle_normals[i], (std::array<std::uint32_t, 3>{12, 10, 11}));
    EXPECT_EQ(mesh.triangle_uvs[i], (std::array<std::uint32_t, 3>{22, 20, 21}));
  }
}

TEST(CornerOrder, LeavesATriangleWithoutALongestEdge) {
  TriangleMesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{1, 2, 0}};
  end_with_longest_edges(mesh);
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{1, 2, 0}));
}

}  // namespace
}  // namespace nook
