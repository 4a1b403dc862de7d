// Hard cases of docs/hard-cases.md that lie in the mesh; each expected value is derived where it stands.
#include <numbers>

#include "hard_case.hpp"

namespace nook::test {
namespace {

class HardMeshes : public HardCases {};

INSTANTIATE_TEST_SUITE_P(Traversals, HardMeshes, every_traversal(), traversal_name);

// A unit sphere on a floor: from a floor point at distance D of its centre it covers the cosine-weighted
// share sin^2(a) cos(t) with sin a = 1/D and cos t = 1/D, so AO = 1 - 1/D^3. The facets of the sphere are
// inside it: 0.002 of slack.
TEST_P(HardMeshes, ContactAtEveryScale) {
  for (const float scale : {1.0f, 1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const Case contact(sphere_on_floor(scale, vec3(0)));
    for (const float x : {0.25f, 0.5f, 1.0f, 2.0f}) {
      const Film film =
          contact.probe(GetParam(), {contact.point(vec3(x * scale, 0, 0), {0, 1, 0})}, 1u << 16);
      expect_near(film.value(0), 1 - std::pow(1 + double(x) * x, -1.5), 1u << 16, 0.002);
    }
  }
}

// Powers of two scale every operation exactly: the same bits.
TEST_P(HardMeshes, PicturesAtPowerOfTwoScalesAreTheSameBits) {
  const auto picture = [&](float scale) {
    Case contact(sphere_on_floor(scale, vec3(0)));
    contact.scene.camera = {vec3(0, 3, 5) * scale, vec3(0, 0.75, 0) * scale, {0, 1, 0}, 32};
    contact.scene.spp = 16;
    return contact.render(GetParam());
  };
  const Film one = picture(1);
  for (const float scale : {0x1p-20f, 0x1p20f}) {
    const Film other = picture(scale);
    EXPECT_EQ(other.sum, one.sum) << scale;
    EXPECT_EQ(other.hits, one.hits) << scale;
  }
}

// Moved by d, positions are rounded to half an ulp of d, e = 2^-24 d: facets turn by about e over their size
// (here 1/16), and AO by as much. Beyond d = 1e4 times the size that is no longer small; then only sane
// values are asked for.
TEST_P(HardMeshes, ContactMovedFarAway) {
  for (const float d : {10.0f, 1e3f, 1e4f, 1e6f}) {
    const Case contact(sphere_on_floor(1, vec3(d)));
    const double rounding = d * 0x1p-24, tolerance = 0.002 + 16 * 4 * rounding;
    const Film film = contact.probe(GetParam(), {contact.point(vec3(d + 1, d, d), {0, 1, 0})}, 1u << 16);
    const double value = film.value(0);
    if (tolerance < 0.2)
      expect_near(value, 1 - std::pow(2.0, -1.5), 1u << 16, tolerance);
    else
      EXPECT_TRUE(value >= 0 && value <= 1) << value;
  }
}

// Two half planes at an angle g, seen from one: (1 - cos g)/2. The plates are 1e4 times the distance to their
// edge, which leaves out less than 1e-4 of the hemisphere.
TEST_P(HardMeshes, SharpWedges) {
  for (const double degrees : {60.0, 10.0, 3.0, 1.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Case corner(wedge(float(angle), 1e4f));
    const Film film = corner.probe(GetParam(), {corner.point({1, 0, 0}, {0, 1, 0})}, 1u << 20);
    expect_near(film.value(0), (1 - std::cos(angle)) / 2, 1u << 20, 1e-4);
  }
}

// A flat floor has nothing above it: AO is exactly 1, however its triangles are made.
TEST_P(HardMeshes, FlatFloorOfBadTrianglesNeverShadowsItself) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    Case floor(bad_floor(scale));
    floor.scene.camera = {vec3(0.3f, 1, 0.4f) * scale, vec3(0), {0, 0, 1}, 60};
    floor.scene.spp = 64;
    expect_all(floor.render(GetParam()), 1);
  }
}

// Inside a closed mesh no direction is open: exactly 0.
TEST_P(HardMeshes, ClosedMeshIsDarkInside) {
  Case star(spiky_star(24, 0.4f));
  star.scene.camera = {{0.1f, 0.05f, 0.02f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 120};
  star.scene.spp = 64;
  star.scene.directions = 8;
  expect_all(star.render(GetParam()), 0);
}

// Nothing to see is black; one triangle from above is open.
TEST_P(HardMeshes, NoTriangleAndOne) {
  Case nothing{TriangleMesh{}};
  nothing.scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 30};
  const Film empty = nothing.render(GetParam());
  for (std::size_t i = 0; i < empty.pixels(); ++i) EXPECT_EQ(empty.hits[i], 0u);
  Case one(single_triangle());
  one.scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 30};
  expect_all(one.render(GetParam()), 1);
}

// Triangles that halve in size towards a corner make the deepest tree that a surface area heuristic can be
// led to; its levels must fit the traversal's stack, and the outermost wall must still be seen through all of
// them.
TEST_P(HardMeshes, WorstCaseDepth) {
  const Case nested(shrinking_triangles(120));
  EXPECT_LE(nested.bvh().statistics.depth, unsigned(BVH_MAX_DEPTH));
  const Film film = nested.probe(
      GetParam(), {nested.point({0, 0, -1}, {0, 0, -1}), nested.point({0.01f, 0.01f, -1}, {0, 0, 1})}, 4096);
  EXPECT_EQ(film.value(0), 1);
  EXPECT_LT(film.value(1), 1);
}

// Whatever share of a stream a pixel's camera rays fill, and whether they agree in their directions' signs
// (packets) or straddle an axis: the camera looks along -y.
TEST(HardMeshesOnce, TraversalsGiveTheSameBits) {
  for (TriangleMesh mesh : {sphere_on_floor(1, vec3(0)), spiky_star(12, 0.4f), bad_floor(1)}) {
    Case both(std::move(mesh));
    for (const Camera& camera :
         {Camera{{0.4f, 3, 5}, {0, 0.5f, 0}, {0, 1, 0}, 40}, Camera{{0, 4, 0}, {0, 0, 0}, {0, 0, 1}, 50}})
      for (const std::uint32_t spp : {1u, 3u, 16u, 40u}) {
        both.scene.camera = camera;
        both.scene.spp = spp;
        const Film stream = both.render(Traversal::stream);
        for (const Traversal other : {Traversal::portable, Traversal::scalar}) {
          const Film film = both.render(other);
          EXPECT_EQ(stream.sum, film.sum) << spp;
          EXPECT_EQ(stream.sum_square, film.sum_square) << spp;
          EXPECT_EQ(stream.hits, film.hits) << spp;
        }
      }
  }
}

}  // namespace
}  // namespace nook::test
