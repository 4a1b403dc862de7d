#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ssao/ssao.hpp"
#include "ssao/view.hpp"
#include "ssao_scenes.hpp"

namespace nook {
namespace {

using test::cast_exactly;

struct Comparison {
  int compared = 0, edges = 0;
};

// Compares G-buffer positions and normals with exact ray casts through the pixel centres.
//
// GL snaps vertices to 1/256 pixel, so a pixel may show what lies up to that far beside its centre: the
// position may be off by as much as the exact position changes over that distance, and a pixel with another
// triangle in that reach is an edge and left out.
Comparison compare_with_ray_casts(const TriangleMesh& mesh, const Camera& camera, int width, int height) {
  SsaoRenderer renderer(mesh);
  const SsaoFrame frame =
      renderer.render(camera, SsaoSettings{}, width, height, {.positions = true, .normals = true});
  const SsaoView view = make_ssao_view(camera, width, height, 0);
  Comparison result;
  const auto cast = [&](double x, double y) {
    const dvec3 direction = dvec3(view.right) * (x * view.ray_scale.x + view.ray_offset.x) +
                            dvec3(view.up) * (y * view.ray_scale.y + view.ray_offset.y) -
                            dvec3(view.backward);
    return cast_exactly(mesh, dvec3(view.eye), direction);
  };
  const double snap = 1.0 / 128;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto hit = cast(x + 0.5, y + 0.5);
      double reach = 0, bend = 0;
      bool edge = false;
      for (const auto& [dx, dy] : {std::pair{-snap, -snap}, {snap, -snap}, {-snap, snap}, {snap, snap}}) {
        const auto beside = cast(x + 0.5 + dx, y + 0.5 + dy);
        edge |= bool(beside) != bool(hit) || (hit && beside->triangle != hit->triangle);
        if (!hit || !beside) continue;
        reach = std::max(reach, glm::length(beside->position - hit->position));
        bend = std::max(bend, glm::length(beside->normal - hit->normal));
      }
      if (edge) {
        ++result.edges;
        continue;
      }
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      EXPECT_EQ(frame.coverage[i], hit ? 1.0f : 0.0f) << x << "," << y;
      ++result.compared;
      const dvec3 position = hit ? hit->position : dvec3(0), normal = hit ? hit->normal : dvec3(0);
      EXPECT_LT(glm::length(dvec3(frame.positions[i]) - position), reach + 1e-5) << x << "," << y;
      EXPECT_LT(glm::length(dvec3(frame.normals[i]) - normal), bend + 1e-5) << x << "," << y;
      if (::testing::Test::HasFailure()) return result;
    }
  return result;
}

TEST(SsaoGBuffer, EqualsExactRayCasts) {
  const Comparison result =
      compare_with_ray_casts(test::asymmetric_scene(), test::asymmetric_camera, 201, 133);
  EXPECT_GT(result.compared, 25000);
  EXPECT_LT(result.edges, 600);
}

TEST(SsaoGBuffer, InterpolatesVertexNormals) {
  TriangleMesh mesh = test::asymmetric_scene();
  test::add_leaning_normals(mesh);
  EXPECT_GT(compare_with_ray_casts(mesh, test::asymmetric_camera, 160, 90).compared, 13000);
}

// A wide camera close to the boxes: depths from 0.1 to the horizon, triangles behind the eye.
TEST(SsaoGBuffer, EqualsExactRayCastsAt150Degrees) {
  const Camera camera{{-0.6f, 0.4f, 0.9f}, {0.3f, 0.35f, -0.4f}, {0, 1, 0}, 150};
  EXPECT_GT(compare_with_ray_casts(test::asymmetric_scene(), camera, 151, 97).compared, 13000);
}

TEST(SsaoGBuffer, DoesNotDependOnScale) {
  const TriangleMesh mesh = test::asymmetric_scene();
  const auto occlusion = [&](float scale) {
    TriangleMesh scaled = mesh;
    scaled.bounds = {};
    for (vec3& p : scaled.positions) scaled.bounds.add(p *= scale);
    Camera camera = test::asymmetric_camera;
    camera.eye *= scale;
    camera.at *= scale;
    SsaoSettings settings;
    settings.radius = 0.25f * scale;
    return SsaoRenderer(scaled).render(camera, settings, 96, 64).occlusion;
  };
  // Powers of two: the same picture to the bit.
  const std::vector<float> unit = occlusion(1);
  EXPECT_EQ(unit, occlusion(0x1p-20f));
  EXPECT_EQ(unit, occlusion(0x1p+20f));
}

}  // namespace
}  // namespace nook
