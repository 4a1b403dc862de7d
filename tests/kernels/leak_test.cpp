// A closed star of spikes, seen from inside: a ray that meets nothing leaked between two triangles.
// NOOK_LEAK_RAYS asks for more rays than the million that a test has time for.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>

#include "ray_tester.hpp"
#include "support/meshes.hpp"

namespace nook::testing {
namespace {

// Vertices at radius 1 and 0.35 in turn on a sphere of n x 2n facets: every point nearer than 0.3 to the
// centre sees every facet.
TriangleMesh star(unsigned n) {
  TriangleMesh mesh;
  test::add_sphere(mesh, dvec3(0), n, [](unsigned i, unsigned j) { return (i + j) % 2 ? 1.0 : 0.35; });
  return mesh;
}

enum class Aim { edge, vertex };

std::uint64_t leaks(RayTester& tester, const TriangleMesh& mesh, Aim aim, std::uint64_t rays) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> uniform(0, 1), inside(-0.15f, 0.15f);
  std::uint64_t leaked = 0;
  for (std::uint64_t done = 0; done < rays; done += 32 * 8192) {
    std::vector<RayStream> streams(8192);
    for (RayStream& stream : streams) {
      stream.origin = {inside(random), inside(random), inside(random)};
      for (vec3& d : stream.direction) {
        const auto& triangle = mesh.triangles[random() % mesh.triangles.size()];
        const vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1 + random() % 2]];
        const float f = aim == Aim::vertex ? 0.0f : uniform(random);
        d = glm::normalize(a + f * (b - a) - stream.origin);
      }
    }
    for (const std::uint32_t bits : tester.occluded(streams, std::numeric_limits<float>::infinity()))
      leaked += 32 - unsigned(__builtin_popcount(bits));
  }
  return leaked;
}

TEST(Leaks, NoneThroughTheEdgesAndVerticesOfAStar) {
  const char* asked = std::getenv("NOOK_LEAK_RAYS");
  const std::uint64_t rays = asked ? std::strtoull(asked, nullptr, 10) : 1'000'000;
  const TriangleMesh mesh = star(40);
  for (const TraversalVariant& variant : traversal_variants()) {
    RayTester tester(mesh, variant);
    EXPECT_EQ(leaks(tester, mesh, Aim::edge, rays / 2), 0u) << variant << ", edges";
    EXPECT_EQ(leaks(tester, mesh, Aim::vertex, rays / 2), 0u) << variant << ", vertices";
  }
}

}  // namespace
}  // namespace nook::testing
