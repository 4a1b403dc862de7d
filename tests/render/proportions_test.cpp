// Closed forms where a surface is up to a million times as large as what is of interest on it: on the kernels
// that users run, with every traversal. Turned scenes are those of their rounded corners, which at 10^6 is
// .03 of the distance of interest; so there only what rounding cannot move is asked for.
#include <numbers>

#include "hard_case.hpp"
#include "support/closed_forms.hpp"
#include "support/meshes.hpp"
#include "support/turned.hpp"

namespace nook::test {
namespace {

using glm::dmat3;

const dmat3 upright(1);

void add_turned_quad(TriangleMesh& mesh, const dmat3& turn, const dvec3& a, const dvec3& b, const dvec3& c,
                     const dvec3& d) {
  add_quad(mesh, vec3(turn * a), vec3(turn * b), vec3(turn * c), vec3(turn * d));
}

// Walls at x = -1 and 1 of this half-length, of height 1.
TriangleMesh corridor(double l, const dmat3& turn) {
  TriangleMesh mesh;
  for (const double x : {-1.0, 1.0})
    add_turned_quad(mesh, turn, {x, 0, -l}, {x, 0, l}, {x, 1, l}, {x, 1, -l});
  return mesh;
}

// A square that faces the floor, at this height.
void add_lid(TriangleMesh& mesh, double height, double r, const dmat3& turn) {
  add_turned_quad(mesh, turn, {-r, height, -r}, {r, height, -r}, {r, height, r}, {-r, height, r});
}

class Proportions : public HardCases {
 protected:
  static constexpr std::uint32_t directions = 1u << 16;
  static constexpr double bias = 0.001;  // Sobol' points are ten times nearer
  static double at_origin(Case& c, Traversal traversal, const dmat3& turn, dvec3 view = {0, 1, 0}) {
    c.scene.sampler = Sampler::sobol;
    const std::vector<SurfacePoint> points(
        16, c.point(vec3(0), vec3(turn * dvec3(0, 1, 0)), vec3(turn * glm::normalize(view))));
    const Film film = c.probe(traversal, points, directions / 16);
    double sum = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) sum += film.value(i);
    return sum / double(film.pixels());
  }
};

TEST_P(Proportions, CorridorOfAnyLength) {
  for (const double l : {2e3, 2e4, 2e5, 5e5}) {
    Case c(corridor(l, upright));
    EXPECT_NEAR(at_origin(c, GetParam(), upright), std::sqrt(0.5), bias);
  }
  for (const double l : {2e3, 2e4, 1e5}) {
    Case c(corridor(l, turned));
    EXPECT_NEAR(at_origin(c, GetParam(), turned), std::sqrt(0.5), bias);
  }
}

// Exponent 1, the mirror direction 20 degrees off the normal, in a corridor without an end.
TEST_P(Proportions, ReflectionsInACorridor) {
  const double view = 20 * std::numbers::pi / 180;
  for (const double l : {2e4, 5e5}) {
    Case c(corridor(l, upright));
    c.reflect(1);
    EXPECT_NEAR(at_origin(c, GetParam(), upright, {-std::sin(view), std::cos(view), 0}), 0.76896, bias);
  }
}

TEST_P(Proportions, CeilingsOverAPoint) {
  for (const dmat3& turn : {upright, turned})
    for (const double r : {1e3, 1e5, 1e6, 1e8}) {
      if (&turn != &upright && r > 1e5) continue;
      TriangleMesh mesh;
      add_lid(mesh, 1, r, turn);
      Case c(std::move(mesh));
      c.limit(2);
      EXPECT_NEAR(at_origin(c, GetParam(), turn), 0.25, bias);
    }
}

// AO = 1 - the form factor of a square of side 2h at height h, however small it is.
TEST_P(Proportions, CeilingNearAPointOfALargeFloor) {
  TriangleMesh mesh;
  add_turned_quad(mesh, upright, {-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5});
  add_lid(mesh, 1e-6, 1e-6, upright);
  Case c(std::move(mesh));
  const double square = 4 * std::sqrt(0.5) * std::atan(std::sqrt(0.5)) * 2 / std::numbers::pi / 2;
  EXPECT_NEAR(at_origin(c, GetParam(), upright), 1 - square, bias);
}

// (h / r)² for a lid at height h within the reach r, in every pixel that sees the floor.
TEST_P(Proportions, LidOverAFloorThatIsRendered) {
  for (const dmat3& turn : {upright, turned})
    for (const double r : {1e3, 1e4, 1e5, 1e6}) {
      if (turn == turned && r > 1e4) continue;
      TriangleMesh mesh;
      add_turned_quad(mesh, turn, {-r, 0, -r}, {-r, 0, r}, {r, 0, r}, {r, 0, -r});
      add_lid(mesh, 0.1, r, turn);
      Case c(std::move(mesh));
      c.limit(0.2f);
      c.scene.camera.eye = vec3(turn * dvec3(0, 0.05, 0));
      c.scene.camera.at = vec3(turn * dvec3(1, -1, 0.3));
      c.scene.camera.up = vec3(turn * dvec3(0, 1, 0));
      c.scene.camera.fov = 40;
      c.scene.sampler = Sampler::sobol;
      c.scene.spp = 16;
      c.scene.directions = 16;
      const Film film = c.render(GetParam());
      double sum = 0;
      for (std::size_t i = 0; i < film.pixels(); ++i) {
        EXPECT_EQ(film.hits[i], film.camera_samples[i]);
        sum += film.value(i);
      }
      EXPECT_NEAR(sum / double(film.pixels()), 0.25, bias);
    }
}

INSTANTIATE_TEST_SUITE_P(AllTraversals, Proportions, every_traversal(), traversal_name);

}  // namespace
}  // namespace nook::test
