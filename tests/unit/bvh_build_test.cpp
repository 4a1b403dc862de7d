// The wide tree's structure: every triangle once, inside every box above it, the same bytes on any number of
// threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "base/error.hpp"
#include "bvh/bvh.hpp"
#include "mesh/corner_order.hpp"

namespace nook {
namespace {

TriangleMesh random_mesh(unsigned count, float size, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float half) { return half * (2 * float(random() >> 8) * 0x1p-24f - 1); };
  const auto point = [&](float half) { return vec3(uniform(half), uniform(half), uniform(half)); };
  TriangleMesh mesh;
  for (unsigned i = 0; i < count; ++i) {
    const vec3 p = point(1);
    mesh.positions.insert(mesh.positions.end(), {p, p + point(size), p + point(size)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

struct Visit {
  const Bvh& bvh;
  const TriangleMesh& mesh;
  std::vector<unsigned> seen;
  unsigned depth = 0;

  void leaf(const TriangleLeaf& leaf, const Bounds3& box) {
    bool ended = false;
    for (int lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
      if (leaf.triangle[lane] == BVH_EMPTY) {
        ended |= lane < BVH_LEAF_PAIRS;
        continue;
      }
      ASSERT_FALSE(ended && lane < BVH_LEAF_PAIRS) << "a gap before lane " << lane;
      ASSERT_NE(leaf.triangle[lane % BVH_LEAF_PAIRS], BVH_EMPTY) << "a second without a first in lane " << lane;
      ++seen.at(leaf.triangle[lane]);
      for (int vertex = 0; vertex < 3; ++vertex)
        for (int axis = 0; axis < 3; ++axis) {
          const float x = leaf.p[axis][BVH_CORNER(vertex, lane)];
          ASSERT_EQ(x, mesh.positions[mesh.triangles[leaf.triangle[lane]][vertex]][axis]);
          ASSERT_LT(box.lo[axis], x);
          ASSERT_GT(box.hi[axis], x);
        }
    }
  }

  void node(std::uint32_t index, const Bounds3& outer, unsigned level) {
    depth = std::max(depth, level);
    const BvhNode& n = bvh.nodes.at(index);
    bool leaves_begun = false;
    float last_area = 0;
    for (int lane = 0; lane < BVH_WIDTH; ++lane) {
      if (lane >= int(BVH_CHILDREN(&n))) {
        ASSERT_EQ(n.lo[0][lane], std::numeric_limits<float>::infinity());
        ASSERT_EQ(n.hi[0][lane], -std::numeric_limits<float>::infinity());
        continue;
      }
      Bounds3 box;
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = n.lo[axis][lane];
        box.hi[axis] = n.hi[axis][lane];
        ASSERT_GE(box.lo[axis], outer.lo[axis]);
        ASSERT_LE(box.hi[axis], outer.hi[axis]);
      }
      const nook_uint item = BVH_ITEM(&n, unsigned(lane));
      const bool is_leaf = item & BVH_LEAF;
      const vec3 e = box.hi - box.lo;
      const float area = e.x * e.y + e.y * e.z + e.z * e.x;
      ASSERT_TRUE(is_leaf || !leaves_begun) << "a node after a leaf";
      if (is_leaf == leaves_begun) {
        ASSERT_GE(area, last_area * 0.999f) << "slots are ordered by rising area";
      }
      leaves_begun = is_leaf;
      last_area = area;
      if (is_leaf)
        leaf(bvh.leaves.at(item & ~BVH_LEAF), box);
      else
        node(item, box, level + 1);
    }
  }
};

void expect_valid(const TriangleMesh& mesh, const Bvh& bvh, unsigned expected_triangles) {
  Visit visit{bvh, mesh, std::vector<unsigned>(mesh.triangles.size())};
  const float infinity = std::numeric_limits<float>::infinity();
  Bounds3 everything;
  everything.lo = vec3(-infinity);
  everything.hi = vec3(infinity);
  visit.node(0, everything, 1);
  unsigned once = 0;
  for (const unsigned times : visit.seen) {
    EXPECT_LE(times, 1u);
    once += times == 1;
  }
  EXPECT_EQ(once, expected_triangles);
  EXPECT_EQ(visit.depth, bvh.statistics.depth);
  EXPECT_LE(visit.depth, unsigned(BVH_MAX_DEPTH));
}

TEST(BvhBuild, HoldsEveryTriangleOnceInsideItsBoxes) {
  for (const unsigned count : {1u, 2u, 8u, 9u, 100u, 5000u, 40000u}) {
    const TriangleMesh mesh = random_mesh(count, 0.1f, count);
    expect_valid(mesh, build_bvh(mesh), count);
  }
}

TEST(BvhBuild, IsTheSameOnAnyNumberOfThreads) {
  // Many enough that several threads share the splitting of the largest nodes.
  const TriangleMesh mesh = random_mesh(400000, 0.02f, 5);
  const Bvh one = build_bvh(mesh, {.threads = 1});
  for (const unsigned threads : {2u, 3u, 8u}) {
    const Bvh many = build_bvh(mesh, {.threads = threads});
    ASSERT_EQ(one.nodes.size(), many.nodes.size());
    ASSERT_EQ(one.leaves.size(), many.leaves.size());
    EXPECT_EQ(std::memcmp(one.nodes.data(), many.nodes.data(), one.nodes.size() * sizeof(BvhNode)), 0);
    EXPECT_EQ(std::memcmp(one.leaves.data(), many.leaves.data(), one.leaves.size() * sizeof(TriangleLeaf)),
              0);
  }
}

// A node is seven cache lines and a leaf four; the kernels fetch them by lines.
TEST(BvhBuild, BeginsAtCacheLines) {
  for (const unsigned count : {0u, 1u, 100u, 40000u}) {
    const Bvh bvh = build_bvh(random_mesh(count, 0.1f, 7));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bvh.nodes.data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bvh.leaves.data()) % 64, 0u);
  }
}

TEST(BvhBuild, HoldsManyTrianglesInOnePlace) {
  TriangleMesh mesh = random_mesh(1, 1, 6);
  mesh.triangles.resize(5000, mesh.triangles[0]);
  expect_valid(mesh, build_bvh(mesh), 5000);
}

TEST(BvhBuild, StaysWithinItsDepthForGeometricallyShrinkingTriangles) {
  // A series of ever smaller triangles: the heuristic peels the large ones off one by one.
  TriangleMesh mesh;
  for (int i = 0; i < 2000; ++i) {
    const float s = std::pow(0.96f, float(i)), x = s;
    const auto n = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {vec3(x, 0, 0), vec3(x, s, 0), vec3(x, 0, s)});
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  expect_valid(mesh, build_bvh(mesh), 2000);
}

TEST(BvhBuild, LeavesOutWhatCannotBeHit) {
  TriangleMesh mesh = random_mesh(20, 0.1f, 7);
  mesh.positions[mesh.triangles[3][1]].y = std::nanf("");
  mesh.positions[mesh.triangles[4][0]].x = std::numeric_limits<float>::infinity();
  mesh.triangles[5][1] = mesh.triangles[5][0];
  expect_valid(mesh, build_bvh(mesh), 17);
}

TEST(BvhBuild, OfNothingIsARootWithoutChildren) {
  const Bvh bvh = build_bvh(TriangleMesh());
  ASSERT_EQ(bvh.nodes.size(), 1u);
  EXPECT_FALSE(bvh.leaves.empty());
  EXPECT_EQ(BVH_CHILDREN(&bvh.nodes[0]), 0u);
}

TEST(BvhBuild, RefusesMoreThanANodeCanPointTo) {
  EXPECT_NO_THROW(check_bvh_size(BVH_FIRST(~0u), BVH_FIRST(~0u)));
  EXPECT_THROW(check_bvh_size(1, std::size_t(BVH_FIRST(~0u)) + 1), Error);
  EXPECT_THROW(check_bvh_size(std::size_t(BVH_FIRST(~0u)) + 1, 1), Error);
}

TEST(BvhBuild, NeedsAtMost80BytesATriangle) {
  // A fine surface, as meshes are; a soup's long triangles need no more.
  TriangleMesh mesh;
  const std::uint32_t n = 300;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.positions.push_back(
          vec3(float(i), std::sin(0.07f * float(i)) * 5 * std::cos(0.05f * float(j)), float(j)));
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  end_with_longest_edges(mesh);  // as a loader does
  EXPECT_LE(double(build_bvh(mesh).bytes()) / double(mesh.triangles.size()), 80.0);
}

}  // namespace
}  // namespace nook
