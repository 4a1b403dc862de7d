// The arithmetic that places meshes: the same on host and device, and boxes hold what is in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "mesh/instance.hpp"
#include "support/kernels.hpp"

namespace nook::test {
namespace {

glm::dmat4 transform(const dvec3& translate, double degrees, const dvec3& axis, const dvec3& scale) {
  return glm::scale(
      glm::rotate(glm::translate(glm::dmat4(1), translate), glm::radians(degrees), glm::normalize(axis)),
      scale);
}

// What the host bakes and what a kernel places, over three million vertices and normals.
TEST(PlacedMeshes, HostAndDevicePlaceAlike) {
  std::mt19937 random(11);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> exponent(-6, 6);
  const auto vector = [&] { return dvec3(gauss(random), gauss(random), gauss(random)); };
  std::vector<PlacedMesh> places;
  for (int i = 0; i < 1000; ++i) {
    const double scale = std::pow(10, exponent(random)), away = std::pow(10, exponent(random));
    places.push_back(
        placed_mesh(transform(away * vector(), 360 * gauss(random), vector(), scale * vector())));
  }
  for (PlacedMesh& place : places) place.meshes = nook_uint(places.size());
  std::vector<vec3> points, normals;
  for (int i = 0; i < 1500000; ++i) {
    points.push_back(vec3(vector()));
    normals.push_back(vec3(glm::normalize(vector())));
  }
  normals[0] = {0, 0, 0};
  std::vector<vec3> placed(points.size()), placed_normals(points.size());
  TestProgram program(test_kernel_source("test_instance.cl"), BuildOptions().define("INSTANCES", 1));
  program.run("place", points.size(), places, points, normals, InOut<vec3>{placed},
              InOut<vec3>{placed_normals});
  std::size_t different = 0;
  double longest = 1, shortest = 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlacedMesh& place = places[i % places.size()];
    const vec3 p = placed_position(place, points[i]), n = placed_normal(place, normals[i]);
    different +=
        std::memcmp(&p, &placed[i], sizeof p) != 0 || std::memcmp(&n, &placed_normals[i], sizeof n) != 0;
    if (i == 0) continue;
    longest = std::max(longest, glm::length(dvec3(n)));
    shortest = std::min(shortest, glm::length(dvec3(n)));
  }
  EXPECT_EQ(different, 0u);
  EXPECT_EQ(placed_normals[0], vec3(0));
  EXPECT_LT(longest, 1 + 3e-7);
  EXPECT_GT(shortest, 1 - 3e-7);
}

// The box that a placed box becomes holds every placed point of it, and is no larger than two of them.
TEST(PlacedMeshes, PlacedBoxesHoldEveryPlacedPoint) {
  std::mt19937 random(13);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<float> unit(0, 1);
  const auto vector = [&] { return dvec3(gauss(random), gauss(random), gauss(random)); };
  for (int i = 0; i < 2000; ++i) {
    const PlacedMesh place =
        placed_mesh(transform(100.0 * vector(), 360 * gauss(random), vector(), vector()));
    Bounds3 box;
    box.add(vec3(vector()));
    box.add(vec3(vector()));
    const Bounds3 placed = placed_bounds(place, box);
    Bounds3 corners;
    for (int corner = 0; corner < 8; ++corner)
      corners.add(placed_position(place, {corner & 1 ? box.lo.x : box.hi.x, corner & 2 ? box.lo.y : box.hi.y,
                                          corner & 4 ? box.lo.z : box.hi.z}));
    EXPECT_EQ(placed.lo, corners.lo);
    EXPECT_EQ(placed.hi, corners.hi);
    for (int k = 0; k < 200; ++k) {
      const vec3 inside = glm::clamp(
          box.lo + vec3(unit(random), unit(random), unit(random)) * (box.hi - box.lo), box.lo, box.hi);
      Bounds3 with = placed;
      with.add(placed_position(place, inside));
      ASSERT_EQ(with.lo, placed.lo);
      ASSERT_EQ(with.hi, placed.hi);
    }
  }
}

}  // namespace
}  // namespace nook::test
