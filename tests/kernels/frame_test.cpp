#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "math/types.hpp"
#include "support/kernels.hpp"

namespace nook::test {
namespace {

// Random unit vectors, and where bases go wrong: the axes with either zero, the poles' neighbourhood, the
// equator.
std::vector<vec3> normals_to_try() {
  std::vector<vec3> normals;
  for (float z : {0.0f, -0.0f}) {
    normals.push_back({1, 0, z});
    normals.push_back({-1, 0, z});
    normals.push_back({0, 1, z});
    normals.push_back({-0.6f, 0.8f, z});
    normals.push_back({z, z, 1});
    normals.push_back({z, z, -1});
  }
  for (float sign : {1.0f, -1.0f})
    for (float s = 1e-30f; s < 0.1f; s *= 3) {
      normals.push_back({s, -s, sign * std::sqrt(1 - 2 * s * s)});
      normals.push_back({std::sqrt(1 - s * s), 0, sign * s});
    }
  std::mt19937 random(20170301);
  std::normal_distribution<double> gauss;
  while (normals.size() < 100000)
    normals.push_back(vec3(glm::normalize(dvec3(gauss(random), gauss(random), gauss(random)))));
  return normals;
}

TEST(Frame, IsOrthonormalRightHandedAndInvertible) {
  std::vector<vec3> normals = normals_to_try(), vectors = normals;
  std::rotate(vectors.begin(), vectors.begin() + 17, vectors.end());
  std::vector<vec3> out(5 * normals.size());
  TestProgram program(test_kernel_source("test_frame.cl"), BuildOptions());
  program.run("frame_at", normals.size(), normals, vectors, InOut<vec3>{out});
  double worst = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    dvec3 t(out[5 * i]), b(out[5 * i + 1]), n(out[5 * i + 2]), world(out[5 * i + 3]), back(out[5 * i + 4]);
    ASSERT_EQ(out[5 * i + 2], normals[i]);
    double error = std::max({std::abs(glm::dot(t, b)), std::abs(glm::dot(t, n)), std::abs(glm::dot(b, n)),
                             std::abs(glm::length(t) - 1), std::abs(glm::length(b) - 1),
                             glm::length(glm::cross(t, b) - n), glm::length(back - dvec3(vectors[i])),
                             std::abs(glm::dot(world, n) - double(vectors[i].z))});
    ASSERT_LT(error, 1e-6) << "normal " << normals[i].x << " " << normals[i].y << " " << normals[i].z;
    worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace nook::test
