// Hard cases of docs/hard-cases.md that lie in normals and lobes; each expected value is derived where it
// stands.
#include <algorithm>
#include <numbers>

#include "hard_case.hpp"
#include "mesh/obj_loader.hpp"
#include "support/closed_forms.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {
namespace {

class HardNormals : public HardCases {};

INSTANTIATE_TEST_SUITE_P(Traversals, HardNormals, every_traversal(), traversal_name);

// An open sky has a closed form for every exponent and angle (tests/support/closed_forms.hpp), with the
// variance of one sample; beside its five standard errors, a few roundings.
TEST_P(HardNormals, PhongExponentsAtEveryViewAngle) {
  constexpr std::uint32_t directions = 1u << 14;
  for (const float exponent : {0.0f, 1.0f, 30.0f, 1e3f, 1e5f, 1e7f}) {
    Case open(single_triangle());
    open.reflect(exponent);
    std::vector<SurfacePoint> points;
    const double degrees[] = {0, 30, 60, 80, 89, 89.99, 90};
    for (const double angle : degrees) {
      const double a = angle * std::numbers::pi / 180;
      points.push_back(open.point({50, 50, 50}, {0, 0, 1}, vec3(float(-std::sin(a)), 0, float(std::cos(a)))));
    }
    const Film film = open.probe(GetParam(), points, directions);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double a = degrees[i] * std::numbers::pi / 180;
      const double variance = open_reflection_variance(Sampling::lobe, exponent, a);
      EXPECT_NEAR(film.value(i), open_reflection(exponent, a),
                  5 * std::sqrt(std::max(variance, 0.0) / directions) + 2e-6)
          << degrees[i] << " degrees, exponent " << exponent;
    }
  }
}

// A floor of half width 2 under a plate at height 1, as an OBJ file whose vertex normals of the floor are the
// given text.
TriangleMesh floor_under_plate(const std::string& normal) {
  const TemporaryFolder folder;
  const std::string corners = normal.empty() ? "f 1 2 3 4\n" : "f 1//1 2//1 3//1 4//1\n";
  write_bytes(folder / "mesh.obj", "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\n" +
                                       (normal.empty() ? "" : "vn " + normal + "\n") + corners +
                                       "v -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 1 -1\nf 5 6 7 8\n");
  return load_obj(folder / "mesh.obj");
}

Film seen_from_the_side(TriangleMesh mesh, Traversal traversal) {
  Case scene(std::move(mesh));
  scene.scene.camera = {{0.3f, 0.5f, 6}, {0, 0, 0}, {0, 1, 0}, 25};
  scene.scene.spp = 64;
  return scene.render(traversal);
}

// A normal that is none gives way to the triangle's own, and one of another length to its direction: the same
// bits.
TEST_P(HardNormals, BadVertexNormalsShadeAsTheTriangle) {
  const Film plain = seen_from_the_side(floor_under_plate(""), GetParam());
  double least = 1;
  for (std::size_t i = 0; i < plain.pixels(); ++i)
    if (plain.hits[i]) least = std::min(least, plain.value(i));
  EXPECT_LT(least, 0.7);
  for (const char* normal : {"0 0 0", "nan 1 0", "0 inf 0", "0 1e-35 0", "0 1e-3 0", "0 1 0", "0 1e30 0"}) {
    const Film film = seen_from_the_side(floor_under_plate(normal), GetParam());
    EXPECT_EQ(film.sum, plain.sum) << normal;
    EXPECT_EQ(film.hits, plain.hits) << normal;
  }
}

// A normal that faces away from the viewer is not turned (docs/estimators.md): the floor is lit from below,
// where nothing is, and rays start there, so that neither the plate nor the floor itself is in the way.
TEST_P(HardNormals, BackFacingVertexNormalsSeeTheOtherSide) {
  Case scene(floor_under_plate("0 -1 0"));
  scene.scene.camera = {{0.3f, 0.5f, 1.8f}, {0, 0, 0.5f}, {0, 1, 0}, 25};
  scene.scene.spp = 64;
  expect_all(scene.render(GetParam()), 1);
}

// A plane whose shading normal leans by t: of the cosine-weighted hemisphere about it, the share (1 + cos
// t)/2 lies above the plane; the rest goes through the plane and is blocked. This is the terminator's whole
// darkening, (1 - cos t)/2.
TEST_P(HardNormals, LeaningNormalsLoseWhatLiesBelowThePlane) {
  for (const double degrees : {5.0, 30.0, 60.0, 85.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    Case plane(leaning_square(1000, angle));
    plane.scene.camera = {{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, 20};
    plane.scene.spp = 256;
    const Film film = plane.render(GetParam());
    double mean = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) mean += film.value(i) / double(film.pixels());
    expect_near(mean, (1 + std::cos(angle)) / 2, std::uint32_t(256 * film.pixels()), 1e-5);
  }
}

// A convex body occludes nothing of itself, AO = 1; smooth normals on its facets lean by at most the angle t
// between a facet's plane and the sphere at its corners, and no pixel loses more than (1 - cos t)/2 to the
// terminator. Facets of n x 2n: t is at most pi/n in each direction, together sqrt(2)/2 pi/n.
TEST_P(HardNormals, TerminatorOfASmoothSphere) {
  for (const unsigned n : {8u, 16u, 64u}) {
    Case sphere(smooth_sphere(n));
    sphere.scene.camera = {{0.3f, 0.4f, 4}, {0, 0, 0}, {0, 1, 0}, 20};
    sphere.scene.spp = 1024;
    const Film film = sphere.render(GetParam());
    const double lean = std::numbers::pi / n * std::numbers::sqrt2 / 2, bound = (1 - std::cos(lean)) / 2;
    double mean = 0, seen = 0, worst = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (film.hits[i] != film.camera_samples[i]) continue;
      mean += 1 - film.value(i);
      worst = std::max(worst, 1 - film.value(i));
      seen += 1;
    }
    mean /= seen;
    EXPECT_GT(seen, 100);
    EXPECT_LE(worst, bound + 5 * std::sqrt(bound / 1024)) << n;
    EXPECT_GT(mean, bound / 20) << n;  // it is there: a smooth sphere of facets is darker than a sphere
    EXPECT_LT(mean, bound / 2) << n;
    RecordProperty("darkening_" + std::to_string(n), std::to_string(mean));
  }
}

}  // namespace
}  // namespace nook::test
