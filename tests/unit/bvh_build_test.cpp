// The wide tree's structure: every triangle once, inside every box above it, the same bytes on any number of
// threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <tuple>

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

/// A fine surface, as meshes are, as a loader leaves it.
TriangleMesh surface(std::uint32_t n) {
  TriangleMesh mesh;
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
  end_with_longest_edges(mesh);
  return mesh;
}

template <unsigned Width>
struct Visit {
  const BvhNodes<Width>& nodes;
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
      ASSERT_NE(leaf.triangle[lane % BVH_LEAF_PAIRS], BVH_EMPTY)
          << "a second without a first in lane " << lane;
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
    const BvhNode<Width>& n = nodes.at(index);
    bool leaves_begun = false;
    float last_area = 0;
    for (int lane = 0; lane < int(Width); ++lane) {
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

template <unsigned Width>
void expect_valid(const TriangleMesh& mesh, const BvhNodes<Width>& nodes, const Bvh& bvh,
                  unsigned expected_triangles) {
  Visit<Width> visit{nodes, bvh, mesh, std::vector<unsigned>(mesh.triangles.size())};
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

void expect_valid(const TriangleMesh& mesh, const Bvh& bvh, unsigned expected_triangles) {
  std::visit([&](const auto& nodes) { expect_valid(mesh, nodes, bvh, expected_triangles); }, bvh.nodes);
}

/// By the number of a node's children, and whether the tree is refined.
class BvhBuild : public ::testing::TestWithParam<std::tuple<unsigned, bool>> {
 protected:
  static Bvh build(const TriangleMesh& mesh, unsigned threads = 0) {
    const auto [width, refined] = GetParam();
    Bvh bvh = build_bvh(mesh, {.threads = threads, .width = width, .refined = refined});
    EXPECT_EQ(bvh.width(), width);
    return bvh;
  }
};

std::span<const std::byte> node_bytes(const Bvh& bvh) {
  return std::visit([](const auto& nodes) { return std::as_bytes(std::span(nodes)); }, bvh.nodes);
}

TEST_P(BvhBuild, HoldsEveryTriangleOnceInsideItsBoxes) {
  for (const unsigned count : {1u, 2u, 8u, 9u, 100u, 5000u, 40000u}) {
    const TriangleMesh mesh = random_mesh(count, 0.1f, count);
    expect_valid(mesh, build(mesh), count);
  }
}

TEST_P(BvhBuild, IsTheSameOnAnyNumberOfThreads) {
  // Many enough that several threads share the splitting of the largest nodes.
  const TriangleMesh mesh = random_mesh(400000, 0.02f, 5);
  const Bvh one = build(mesh, 1);
  for (const unsigned threads : {2u, 3u, 8u}) {
    const Bvh many = build(mesh, threads);
    ASSERT_EQ(one.leaves.size(), many.leaves.size());
    EXPECT_TRUE(std::ranges::equal(node_bytes(one), node_bytes(many)));
    EXPECT_EQ(std::memcmp(one.leaves.data(), many.leaves.data(), one.leaves.size() * sizeof(TriangleLeaf)),
              0);
  }
}

// A node is seven cache lines, or four, and a leaf four; the kernels fetch them by lines.
TEST_P(BvhBuild, BeginsAtCacheLines) {
  for (const unsigned count : {0u, 1u, 100u, 40000u}) {
    const Bvh bvh = build(random_mesh(count, 0.1f, 7));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(node_bytes(bvh).data()) % 64, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bvh.leaves.data()) % 64, 0u);
  }
}

TEST_P(BvhBuild, HoldsManyTrianglesInOnePlace) {
  TriangleMesh mesh = random_mesh(1, 1, 6);
  mesh.triangles.resize(5000, mesh.triangles[0]);
  expect_valid(mesh, build(mesh), 5000);
}

TEST_P(BvhBuild, StaysWithinItsDepthForGeometricallyShrinkingTriangles) {
  // A series of ever smaller triangles: the heuristic peels the large ones off one by one.
  TriangleMesh mesh;
  for (int i = 0; i < 2000; ++i) {
    const float s = std::pow(0.96f, float(i)), x = s;
    const auto n = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {vec3(x, 0, 0), vec3(x, s, 0), vec3(x, 0, s)});
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  expect_valid(mesh, build(mesh), 2000);
}

TEST_P(BvhBuild, LeavesOutWhatCannotBeHit) {
  TriangleMesh mesh = random_mesh(20, 0.1f, 7);
  mesh.positions[mesh.triangles[3][1]].y = std::nanf("");
  mesh.positions[mesh.triangles[4][0]].x = std::numeric_limits<float>::infinity();
  mesh.triangles[5][1] = mesh.triangles[5][0];
  expect_valid(mesh, build(mesh), 17);
}

TEST_P(BvhBuild, OfNothingIsARootWithoutChildren) {
  const Bvh bvh = build(TriangleMesh());
  EXPECT_FALSE(bvh.leaves.empty());
  std::visit(
      [](const auto& nodes) {
        ASSERT_EQ(nodes.size(), 1u);
        EXPECT_EQ(BVH_CHILDREN(&nodes[0]), 0u);
      },
      bvh.nodes);
}

TEST(BvhSize, RefusesMoreThanANodeCanPointTo) {
  EXPECT_NO_THROW(check_bvh_size(BVH_FIRST(~0u), BVH_FIRST(~0u)));
  EXPECT_THROW(check_bvh_size(1, std::size_t(BVH_FIRST(~0u)) + 1), Error);
  EXPECT_THROW(check_bvh_size(std::size_t(BVH_FIRST(~0u)) + 1, 1), Error);
}

TEST_P(BvhBuild, HoldsPairs) {
  const TriangleMesh mesh = surface(120);
  const Bvh bvh = build(mesh);
  expect_valid(mesh, bvh, unsigned(mesh.triangles.size()));
  std::size_t seconds = 0;
  for (const TriangleLeaf& leaf : bvh.leaves)
    for (unsigned lane = BVH_LEAF_PAIRS; lane < BVH_LEAF_WIDTH; ++lane)
      seconds += leaf.triangle[lane] != BVH_EMPTY;
  EXPECT_GT(seconds, mesh.triangles.size() * 2 / 5);
}

TEST_P(BvhBuild, OfPairsIsTheSameOnAnyNumberOfThreads) {
  const TriangleMesh mesh = surface(260);
  const Bvh one = build(mesh, 1), many = build(mesh, 3);
  EXPECT_TRUE(std::ranges::equal(node_bytes(one), node_bytes(many)));
  ASSERT_EQ(one.leaves.size(), many.leaves.size());
  EXPECT_EQ(std::memcmp(one.leaves.data(), many.leaves.data(), one.leaves.size() * sizeof(TriangleLeaf)), 0);
}

TEST_P(BvhBuild, NeedsAtMost70BytesATriangleOfAFineSurface) {
  const TriangleMesh mesh = surface(300);
  EXPECT_LE(double(build(mesh).bytes()) / double(mesh.triangles.size()), 70.0);
}

// Boxes beyond the floats' range, and areas that are: no search by them may go on for ever.
TEST_P(BvhBuild, HoldsTrianglesAtTheEndsOfTheFloats) {
  TriangleMesh mesh = random_mesh(3000, 0.1f, 8);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 7) mesh.positions[i] *= i % 2 ? 1e37f : 1e20f;
  expect_valid(mesh, build(mesh), 3000);
}

INSTANTIATE_TEST_SUITE_P(Widths, BvhBuild, ::testing::Combine(::testing::Values(16u, 8u), ::testing::Bool()),
                         [](const auto& test) {
                           return std::to_string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) ? "_refined" : "");
                         });

// A few large triangles among many small ones, which planes between centres leave where they enlarge every
// box up to the root.
TEST(BvhRefinement, TakesLargeTrianglesOutOfSmallBoxes) {
  TriangleMesh mesh = random_mesh(20000, 0.01f, 9);
  const TriangleMesh large = random_mesh(200, 2, 10);
  for (const auto& t : large.triangles) {
    const auto n = std::uint32_t(mesh.positions.size());
    for (const std::uint32_t corner : t) mesh.positions.push_back(large.positions[corner]);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  const Bvh plain = build_bvh(mesh), refined = build_bvh(mesh, BvhOptions{.refined = true});
  EXPECT_LT(refined.statistics.sah_cost, .95 * plain.statistics.sah_cost);
}

}  // namespace
}  // namespace nook
