// Occlusion bits against Embree ROBUST: random rays and rays aimed at edges and vertices, on meshes of the
// project's own kind. Every ray on which the two differ must be explained: a silhouette, or the ray's end on
// a surface, within what float rounding decides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "ray_tester.hpp"
#include "support/meshes.hpp"
#include "support/oracle.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

using testing::RayStream;
using testing::RayTester;

// A bumpy torus of 2 x 160 x 320 triangles: slivers, concave parts, shared edges everywhere.
TriangleMesh bumpy_torus() {
  const int around = 320, across = 160;
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      double r = 0.35 + 0.05 * std::sin(7 * a) * std::cos(5 * b);
      vec3 p(float((1 + r * std::cos(b)) * std::cos(a)), float((1 + r * std::cos(b)) * std::sin(a)),
             float(r * std::sin(b)));
      mesh.positions.push_back(p);
      mesh.bounds.add(p);
    }
  auto index = [&](int i, int j) { return std::uint32_t((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

std::vector<RayStream> streams_about(const TriangleMesh& mesh, std::size_t count, bool aimed,
                                     std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::uniform_int_distribution<std::size_t> triangle(0, mesh.triangles.size() - 1);
  auto in_ball = [&] {
    for (;;)
      if (vec3 v(uniform(random), uniform(random), uniform(random));
          glm::dot(v, v) > 0.01f && glm::dot(v, v) < 1)
        return v;
  };
  std::vector<RayStream> streams(count);
  for (RayStream& stream : streams) {
    stream.origin = 1.5f * in_ball();
    for (vec3& d : stream.direction) {
      d = glm::normalize(in_ball());
      if (!aimed) continue;
      const auto& t = mesh.triangles[triangle(random)];
      float along = (uniform(random) + 1) / 2 * float(random() % 4 != 0);  // a vertex every fourth time
      vec3 target = glm::mix(mesh.positions[t[0]], mesh.positions[t[1]], along) - stream.origin;
      if (glm::dot(target, target) > 1e-6f) d = glm::normalize(target);
    }
  }
  return streams;
}

// True if Embree itself changes its answer within float rounding of the ray: turned by 4e-6 in eight
// directions (inside a watertight surface it would not), or cut a little shorter or longer.
bool too_close_to_call(const OracleTracer& embree, const dvec3& o, const dvec3& d, double limit,
                       bool answer) {
  dvec3 x = glm::normalize(glm::cross(std::abs(d.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), d)),
        y = glm::cross(d, x);
  for (int k = 0; k < 8; ++k) {
    double angle = 2 * std::numbers::pi * k / 8;
    if (embree.occluded(o, glm::normalize(d + 4e-6 * (std::cos(angle) * x + std::sin(angle) * y)), limit) !=
        answer)
      return true;
  }
  return embree.occluded(o, d, limit * (1 - 4e-6)) != answer ||
         embree.occluded(o, d, limit * (1 + 4e-6)) != answer;
}

TEST(Embree, OcclusionBitsAgreeOrAreTooCloseToCall) {
  const float infinity = std::numeric_limits<float>::infinity();
  std::size_t per_case = (long_mode() ? 80'000'000 : 10'000'000) / 32 / 8, rays = 0, different[2] = {};
  for (const TriangleMesh& mesh : {bumpy_torus(), courtyard()}) {
    RayTester tester(mesh);
    OracleTracer embree = embree_robust(mesh);
    for (bool aimed : {false, true})
      for (float limit : {infinity, 0.7f}) {
        std::vector<RayStream> streams = streams_about(mesh, per_case, aimed, test_seed(61) + aimed);
        std::vector<std::uint32_t> bits = tester.occluded(streams, limit);
        for (std::size_t i = 0; i < streams.size(); ++i)
          for (int k = 0; k < 32; ++k) {
            dvec3 o(streams[i].origin), d(streams[i].direction[std::size_t(k)]);
            bool ours = bits[i] >> k & 1, theirs = embree.occluded(o, d, double(limit));
            ++rays;
            if (ours == theirs) continue;
            ++different[aimed];
            ASSERT_TRUE(too_close_to_call(embree, o, d, double(limit), theirs))
                << (ours ? "hit" : "miss") << " that Embree denies: origin " << o.x << " " << o.y << " "
                << o.z << " direction " << d.x << " " << d.y << " " << d.z << " limit " << limit;
          }
      }
  }
  std::printf(
      "%zu rays: of the random half %zu differ from Embree, of the aimed half %zu, each too close to call\n",
      rays, different[0], different[1]);
  EXPECT_LT(double(different[0]), 1e-5 * double(rays));
  EXPECT_LT(double(different[1]), 2e-2 * double(rays));  // aimed at edges that are silhouettes
}

}  // namespace
}  // namespace nook::test
