// Occlusion and closest hits on PoCL against brute force in double precision, between the variants, and where
// rounding hurts: edges, vertices, axis-parallel rays, tiny and huge scales.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bvh/triangle_pairs.hpp"
#include "mesh/corner_order.hpp"
#include "ray_tester.hpp"
#include "support/meshes.hpp"

namespace nook::testing {
namespace {

using test::add_sphere;
using test::add_triangle;
using test::closed_box;

const float infinity = std::numeric_limits<float>::infinity();

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float uniform(float lo = 0, float hi = 1) { return lo + (hi - lo) * float(engine_() >> 8) * 0x1p-24f; }
  std::uint32_t below(std::uint32_t n) { return std::uint32_t((std::uint64_t(engine_()) * n) >> 32); }
  vec3 in_box(float half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  vec3 direction() {
    for (;;) {
      const vec3 v = in_box(1);
      const float l = glm::dot(v, v);
      if (l > 0.01f && l <= 1) return v / std::sqrt(l);
    }
  }

 private:
  std::mt19937 engine_;
};

TriangleMesh triangle_soup(unsigned count, float size, unsigned seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (unsigned i = 0; i < count; ++i) {
    const vec3 p = random.in_box(1);
    add_triangle(mesh, p, p + random.in_box(size), p + random.in_box(size));
  }
  return mesh;
}

TriangleMesh sphere(const vec3& center, float radius, unsigned n) {
  TriangleMesh mesh;
  add_sphere(mesh, center, n, [&](unsigned, unsigned) { return radius; });
  end_with_longest_edges(mesh);  // as a loader does: its tree has pairs
  return mesh;
}

const vec3& corner(const TriangleMesh& mesh, std::size_t triangle, int k) {
  return mesh.positions[mesh.triangles[triangle][k]];
}

enum class Truth { miss, hit, too_close_to_call };

/// A ray against one triangle in double precision; `slack`: relative distance to an edge or the limit below
/// which a float computation may differ.
Truth exact(const TriangleMesh& mesh, std::size_t i, const dvec3& o, const dvec3& d, double limit,
            double slack, double* t) {
  const dvec3 a = dvec3(corner(mesh, i, 0)) - o, b = dvec3(corner(mesh, i, 1)) - o,
              c = dvec3(corner(mesh, i, 2)) - o;
  const dvec3 n = glm::cross(b - a, c - a);
  const double height = glm::dot(a, n), approach = glm::dot(d, n);
  const double extent = std::max({glm::length(a), glm::length(b), glm::length(c)});
  const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  const double side = approach < 0 ? -1 : 1;
  const double least =
      side * std::min({side * glm::dot(d, glm::cross(b, c)), side * glm::dot(d, glm::cross(c, a)),
                       side * glm::dot(d, glm::cross(a, b))});
  const double inside = side * least, margin = slack * extent * edge;
  if (inside < -margin) return Truth::miss;
  *t = height / approach;
  const double t_margin = slack * extent * (1 + glm::length(n) / std::abs(approach));
  if (std::abs(approach) < slack * glm::length(n)) return Truth::too_close_to_call;
  if (*t < -t_margin || *t > limit + t_margin) return Truth::miss;
  if (inside > margin && *t > t_margin && *t < limit - t_margin) return Truth::hit;
  return Truth::too_close_to_call;
}

std::vector<RayStream> random_streams(unsigned count, unsigned seed, float half) {
  Random random(seed);
  std::vector<RayStream> streams(count);
  for (RayStream& s : streams) {
    s.origin = random.in_box(half);
    for (vec3& d : s.direction) d = random.direction();
  }
  return streams;
}

/// Directions along axes and in coordinate planes, with zeros of both signs and subnormal components.
std::vector<RayStream> axis_parallel_streams(unsigned count, unsigned seed) {
  Random random(seed);
  const float tiny[] = {0.0f, -0.0f, 1e-40f, -1e-40f, 1e-30f, -1e-30f};
  std::vector<RayStream> streams(count);
  for (RayStream& s : streams) {
    s.origin = {float(random.below(9)) / 4 - 1, float(random.below(9)) / 4 - 1,
                float(random.below(9)) / 4 - 1};
    if (random.below(2)) s.origin += random.in_box(0.1f);
    for (vec3& d : s.direction) {
      const int axis = int(random.below(3));
      d[axis] = random.below(2) ? 1.0f : -1.0f;
      d[(axis + 1) % 3] = tiny[random.below(6)];
      d[(axis + 2) % 3] = tiny[random.below(6)];
      if (random.below(3) == 0) {  // in a coordinate plane
        d[(axis + 1) % 3] = random.below(2) ? 1.0f : -1.0f;
        d = d / std::sqrt(2.0f);
      }
    }
  }
  return streams;
}

/// Directions that nearly agree, as the camera rays of a pixel do; some streams straddle an axis or a
/// diagonal.
std::vector<RayStream> narrow_streams(unsigned count, unsigned seed) {
  Random random(seed);
  std::vector<RayStream> streams(count);
  for (RayStream& s : streams) {
    s.origin = random.in_box(1.5f);
    vec3 axis = random.direction();
    if (random.below(4) == 0) axis[int(random.below(3))] = 0;
    if (random.below(4) == 0) axis.x = axis.y;
    const float width = std::ldexp(1.0f, -int(random.below(12)));
    for (vec3& d : s.direction) d = glm::normalize(axis + width * random.in_box(0.5f));
  }
  return streams;
}

struct Case {
  const char* name;
  TriangleMesh mesh;
};

std::vector<Case> cases() {
  std::vector<Case> result;
  result.push_back({"soup", triangle_soup(3000, 0.15f, 1)});
  result.push_back({"slivers", triangle_soup(300, 1.0f, 2)});
  result.push_back({"sphere", sphere({0, 0, 0}, 0.9f, 24)});
  result.push_back({"box", closed_box(6)});
  result.push_back({"one triangle", triangle_soup(1, 1.0f, 3)});
  return result;
}

TEST(Traverse, OcclusionMatchesBruteForce) {
  for (const Case& c : cases())
    for (const TraversalVariant& variant : traversal_variants()) {
      RayTester tester(c.mesh, variant);
      for (const float limit : {infinity, 0.3f}) {
        std::vector<RayStream> streams = random_streams(40, 11, 1.2f);
        for (const RayStream& s : axis_parallel_streams(20, 12)) streams.push_back(s);
        const auto bits = tester.occluded(streams, limit);
        unsigned wrong = 0, decided = 0;
        for (std::size_t i = 0; i < streams.size(); ++i)
          for (int k = 0; k < 32; ++k) {
            Truth truth = Truth::miss;
            for (std::size_t j = 0; j < c.mesh.triangles.size() && truth != Truth::hit; ++j) {
              double t;
              const Truth one = exact(c.mesh, j, streams[i].origin, streams[i].direction[k], limit, 1e-5, &t);
              if (one != Truth::miss) truth = one;
            }
            if (truth == Truth::too_close_to_call) continue;
            ++decided;
            wrong += bool(bits[i] >> k & 1) != (truth == Truth::hit);
          }
        EXPECT_EQ(wrong, 0u) << c.name << ", " << variant << ", limit " << limit;
        EXPECT_GT(decided, streams.size() * 32 / 3) << c.name;
      }
    }
}

TEST(Traverse, ClosestMatchesBruteForce) {
  for (const Case& c : cases())
    for (const TraversalVariant& variant : traversal_variants()) {
      RayTester tester(c.mesh, variant);
      const std::vector<RayStream> streams = random_streams(40, 21, 1.2f);
      const auto hits = tester.closest(streams, infinity);
      for (std::size_t i = 0; i < streams.size(); ++i)
        for (int k = 0; k < 32; ++k) {
          double nearest = infinity, doubtful = infinity;
          for (std::size_t j = 0; j < c.mesh.triangles.size(); ++j) {
            double t;
            const Truth one =
                exact(c.mesh, j, streams[i].origin, streams[i].direction[k], infinity, 1e-5, &t);
            if (one == Truth::hit) nearest = std::min(nearest, t);
            if (one == Truth::too_close_to_call) doubtful = std::min(doubtful, t);
          }
          if (doubtful <= nearest) continue;
          const ClosestHit& hit = hits[32 * i + k];
          ASSERT_EQ(hit.triangle == 0xffffffffu, nearest == infinity) << c.name << ", " << variant;
          if (nearest == infinity) continue;
          ASSERT_NEAR(hit.t, nearest, 1e-4 * nearest + 1e-5) << c.name << ", " << variant;
          // The barycentric point and the ray's point are one.
          const vec3 a = corner(c.mesh, hit.triangle, 0), b = corner(c.mesh, hit.triangle, 1);
          const vec3 e = corner(c.mesh, hit.triangle, 2);
          const vec3 on_triangle = (1 - hit.u - hit.v) * a + hit.u * b + hit.v * e;
          const vec3 on_ray = streams[i].origin + hit.t * streams[i].direction[k];
          ASSERT_LT(glm::length(on_triangle - on_ray), 1e-4f) << c.name << ", " << variant;
        }
    }
}

TEST(Traverse, VariantsAgreeToTheBit) {
  for (const Case& c : cases()) {
    std::vector<RayStream> streams = random_streams(2000, 31, 1.2f);
    for (const RayStream& s : axis_parallel_streams(500, 32)) streams.push_back(s);
    for (const float limit : {infinity, 0.3f}) {
      std::vector<std::uint32_t> first;
      for (const TraversalVariant& variant : traversal_variants()) {
        RayTester tester(c.mesh, variant);
        const auto bits = tester.occluded(streams, limit);
        if (first.empty()) first = bits;
        EXPECT_EQ(first, bits) << c.name << ", " << variant << ", limit " << limit;
        EXPECT_EQ(first, tester.occluded_own_origins(streams, limit))
            << c.name << ", " << variant << ", own origins";
      }
    }
  }
}

TEST(Traverse, ClosestHitsAgreeToTheBit) {
  for (const Case& c : cases()) {
    std::vector<RayStream> streams = narrow_streams(2000, 33);
    for (const RayStream& s : random_streams(500, 34, 1.2f)) streams.push_back(s);
    for (const RayStream& s : axis_parallel_streams(500, 35)) streams.push_back(s);
    for (const float limit : {infinity, 0.3f}) {
      std::vector<ClosestHit> first;
      for (const TraversalVariant& variant : traversal_variants()) {
        RayTester tester(c.mesh, variant);
        const auto hits = tester.closest(streams, limit);
        if (first.empty()) first = hits;
        std::size_t different = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
          const ClosestHit &a = first[i], &b = hits[i];
          const bool hit = a.triangle != 0xffffffffu;
          different += a.triangle != b.triangle || (hit && (a.t != b.t || a.u != b.u || a.v != b.v));
        }
        EXPECT_EQ(different, 0u) << c.name << ", " << variant << ", limit " << limit;
      }
    }
  }
}

// A triangle by itself and as half of a pair: the same operations on the same corners. The halves are taken
// apart by putting them into two trees, whose answers are then put together.
TEST(Traverse, PairsChangeNoBit) {
  const TriangleMesh mesh = sphere({0, 0, 0}, 0.9f, 24);
  TaskPool pool(1);
  TriangleMesh half[2] = {mesh, mesh};
  std::vector<std::uint32_t> number[2];
  half[0].triangles.clear(), half[1].triangles.clear();
  for (const TrianglePair& pair : pair_triangles(mesh, pool))
    for (const auto& [side, triangle] : {std::pair{0, pair.first}, std::pair{1, pair.second}}) {
      if (triangle == BVH_EMPTY) continue;
      half[side].triangles.push_back(mesh.triangles[triangle]);
      number[side].push_back(triangle);
    }
  ASSERT_GT(number[1].size(), mesh.triangles.size() / 3);
  std::vector<RayStream> streams = narrow_streams(1000, 36);
  for (const RayStream& s : random_streams(500, 37, 1.2f)) streams.push_back(s);
  for (const TraversalVariant& variant : traversal_variants()) {
    RayTester whole(mesh, variant), first(half[0], variant), second(half[1], variant);
    auto bits = first.occluded(streams, 0.8f);
    const auto others = second.occluded(streams, 0.8f);
    for (std::size_t i = 0; i < bits.size(); ++i) bits[i] |= others[i];
    EXPECT_EQ(whole.occluded(streams, 0.8f), bits) << variant;
    auto hits = first.closest(streams, infinity);
    const auto more = second.closest(streams, infinity), all = whole.closest(streams, infinity);
    std::size_t different = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ClosestHit a = hits[i], b = more[i];
      if (a.triangle != BVH_EMPTY) a.triangle = number[0][a.triangle];
      if (b.triangle != BVH_EMPTY) b.triangle = number[1][b.triangle];
      const bool second_is_nearer = b.t < a.t || (b.t == a.t && b.triangle < a.triangle);
      const ClosestHit& nearest = second_is_nearer ? b : a;
      different += nearest.triangle != all[i].triangle ||
                   (nearest.triangle != BVH_EMPTY &&
                    (nearest.t != all[i].t || nearest.u != all[i].u || nearest.v != all[i].v));
    }
    EXPECT_EQ(different, 0u) << variant;
  }
}

// Wherever a variant's tree holds them, and in whatever order it comes to them.
TEST(Traverse, OfEquallyNearTrianglesTheLowestIsMet) {
  TriangleMesh mesh = sphere({0, 0, 0}, 0.9f, 24);
  const std::uint32_t once = std::uint32_t(mesh.triangles.size());
  for (std::uint32_t i = once; i-- > 0;) mesh.triangles.push_back(mesh.triangles[i]);
  std::vector<RayStream> streams = narrow_streams(200, 36);
  for (const RayStream& s : random_streams(200, 37, 0.5f)) streams.push_back(s);
  for (const TraversalVariant& variant : traversal_variants()) {
    unsigned first = 0, second = 0;
    for (const ClosestHit& hit : RayTester(mesh, variant).closest(streams, infinity))
      if (hit.triangle != 0xffffffffu) ++(hit.triangle < once ? first : second);
    EXPECT_GT(first, 6400u) << variant;
    EXPECT_EQ(second, 0u) << variant;
  }
}

/// From inside a closed mesh every ray must meet it: those aimed at edges and vertices are the ones that
/// leak.
std::uint64_t leaks(RayTester& tester, const TriangleMesh& mesh, bool vertices, unsigned seed) {
  Random random(seed);
  std::vector<RayStream> streams(20000);
  for (RayStream& s : streams) {
    s.origin = random.in_box(0.3f);
    for (vec3& d : s.direction) {
      const std::size_t i = random.below(std::uint32_t(mesh.triangles.size()));
      const float f = vertices ? 0.0f : random.uniform();
      d = glm::normalize((1 - f) * corner(mesh, i, 0) + f * corner(mesh, i, 1) - s.origin);
    }
  }
  std::uint64_t result = 0;
  for (const std::uint32_t bits : tester.occluded(streams, infinity))
    result += 32 - unsigned(__builtin_popcount(bits));
  return result;
}

TEST(Traverse, NoRayLeaksThroughEdgesOrVertices) {
  for (const auto& [name, mesh] : {Case{"sphere", sphere({0, 0, 0}, 1, 40)}, Case{"box", closed_box(10)}})
    for (const TraversalVariant& variant : traversal_variants()) {
      RayTester tester(mesh, variant);
      EXPECT_EQ(leaks(tester, mesh, false, 41), 0u) << name << " edges, " << variant;
      EXPECT_EQ(leaks(tester, mesh, true, 42), 0u) << name << " vertices, " << variant;
    }
}

// Seen from its outside a convex body occludes nothing of itself: every hit of a ray that leaves a face is
// with that face.
TEST(Traverse, NoRayMeetsTheSurfaceItLeaves) {
  for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
    for (const vec3& center : {vec3(0, 0, 0), vec3(30, -7, 11)}) {
      const TriangleMesh mesh = sphere(scale * center, scale, 12);
      RayTester tester(mesh);
      Random random(61);
      std::vector<SurfaceSample> samples(2000);
      std::vector<RayStream> streams(samples.size());
      for (std::size_t i = 0; i < samples.size(); ++i) {
        SurfaceSample& s = samples[i];
        const std::size_t triangle = random.below(std::uint32_t(mesh.triangles.size()));
        s.p0 = corner(mesh, triangle, 0), s.p1 = corner(mesh, triangle, 1), s.p2 = corner(mesh, triangle, 2);
        s.u = random.uniform();
        s.v = random.uniform() * (1 - s.u);
        const dvec3 n = glm::normalize(glm::cross(dvec3(s.p1) - dvec3(s.p0), dvec3(s.p2) - dvec3(s.p0)));
        s.normal = n;
        s.side = glm::dot(n, dvec3(s.p0) - dvec3(scale * center)) > 0 ? 1.0f : -1.0f;
        for (vec3& d : streams[i].direction) {
          do d = random.direction();
          while (std::abs(glm::dot(dvec3(d), n)) < 1e-3);
          if (glm::dot(d, s.normal) * s.side < 0) d = -d;
        }
      }
      const std::vector<vec3> origins = tester.offset_origins(samples);
      for (std::size_t i = 0; i < origins.size(); ++i) streams[i].origin = origins[i];
      unsigned hits = 0;
      for (const std::uint32_t bits : tester.occluded(streams, infinity))
        hits += unsigned(__builtin_popcount(bits));
      EXPECT_EQ(hits, 0u) << "of 64000 rays, scale " << scale << ", centre at " << glm::length(center)
                          << " radii";
      // The offset stays far below the features: a few roundings of the coordinates.
      for (std::size_t i = 0; i < origins.size(); ++i) {
        const SurfaceSample& s = samples[i];
        const vec3 p = (1 - s.u - s.v) * s.p0 + s.u * s.p1 + s.v * s.p2;
        ASSERT_LT(glm::length(origins[i] - p), scale * 2e-6f * (1 + 3 * glm::length(center)));
      }
    }
}

TEST(Traverse, NothingMeetsAnEmptyOrDegenerateMesh) {
  TriangleMesh points;
  add_triangle(points, {0, 0, 0}, {0, 0, 0}, {1, 1, 1});
  for (const TriangleMesh& mesh : {TriangleMesh(), points})
    for (const TraversalVariant& variant : traversal_variants()) {
      RayTester tester(mesh, variant);
      for (const std::uint32_t bits : tester.occluded(random_streams(100, 51, 2), infinity))
        ASSERT_EQ(bits, 0u) << variant;
      for (const ClosestHit& hit : tester.closest(random_streams(100, 51, 2), infinity))
        ASSERT_EQ(hit.triangle, 0xffffffffu) << variant;
    }
}

}  // namespace
}  // namespace nook::testing
