// AO on meshes against closed forms, through the kernels that renders use.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "point_cases.hpp"

namespace nook::test {
namespace {

// The mesh turned, scaled and moved, and the receiver with it.
struct Placement {
  glm::quat rotation{1, 0, 0, 0};
  float scale = 1;
  vec3 offset{0};
  vec3 apply(const vec3& p) const { return scale * (rotation * p) + offset; }
};

TriangleMesh placed(const TriangleMesh& mesh, const Placement& placement) {
  TriangleMesh out = mesh;
  out.bounds = {};
  for (vec3& p : out.positions) out.bounds.add(p = placement.apply(p));
  return out;
}

TEST(Ambient, OfPolygons) {
  for (const PolygonCase& c : polygon_cases())
    for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
      Renderer renderer(scene_of(EffectKind::ao, sampling, Sampler::independent, c.limit), c.mesh);
      std::vector<SurfacePoint> points(4096, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0)));
      expect_mean(renderer.at_points(points, 256), c.value, 3.5, c.name + ", " + name_of(sampling));
    }
}

// Where floats are coarse or fine the result must not change: scales of 1e-3 and 1e3, far from the origin,
// tilted.
TEST(Ambient, DoesNotDependOnPlacement) {
  const glm::quat tilt = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f));
  const Placement placements[] = {
      {tilt, 1, {0, 0, 0}}, {tilt, 1e-3f, {0, 0, 0}}, {tilt, 1e3f, {0, 0, 0}}, {tilt, 1, {100, -50, 30}}};
  const PolygonCase c = polygon_cases()[2];
  for (const Placement& placement : placements) {
    TriangleMesh mesh = placed(c.mesh, placement);
    Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, Sampler::sobol, 0), mesh);
    std::vector<SurfacePoint> points(
        1024, surface_point(placement.apply({0, 0, 0}), placement.rotation * vec3(0, 0, 1), vec3(0)));
    // At 100 units positions are rounded by 4e-6: the value moves by that much times the gradient.
    expect_mean(renderer.at_points(points, 256), c.value, 4.5,
                "scale " + std::to_string(placement.scale) + ", x " + std::to_string(placement.offset.x));
  }
}

TEST(Ambient, WithEverySampler) {
  const PolygonCase c = polygon_cases()[0];
  for (Sampler sampler : {Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder})
    for (std::uint32_t directions : {256u, 100u}) {
      std::vector<double> replicates;
      std::vector<SurfacePoint> points(1024, surface_point({0, 0, 0}, {0, 0, 1}, vec3(0)));
      Renderer renderer(scene_of(EffectKind::ao, Sampling::cosine, sampler, 0), c.mesh);
      Film film = renderer.at_points(points, directions);
      if (sampler != Sampler::zorder) {
        expect_mean(film, c.value, 4.5, name_of(sampler) + ", " + std::to_string(directions));
        continue;
      }
      // Neighbouring rows of a Z-order continue one point set: their mean is far better than independent
      // rows' would be.
      double mean = 0;
      for (std::size_t i = 0; i < film.pixels(); ++i) mean += film.value(i) / double(film.pixels());
      EXPECT_NEAR(mean, c.value, 1e-3) << directions;  // independent rows of the same size: 8e-4 each way
    }
}

}  // namespace
}  // namespace nook::test
