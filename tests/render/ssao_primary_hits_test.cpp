// What SSAO's G-buffer holds, against the camera rays' hits: both by the whole program.
#include <gtest/gtest.h>

#include <cmath>

#include "math/types.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

constexpr const char* traced = "[renderer]\ntype = \"ao\"\nspp = 1\nmax_distance = 0.5\n";
constexpr const char* screen_space =
    "[renderer]\nrealtime = true\ntype = \"ssao\"\nmethod = \"march\"\nquality = \"accurate\"\nradius = "
    "0.5\n";
constexpr int width = 48;

// Channels NAME.X, NAME.Y, NAME.Z.
std::vector<vec3> vectors(const Image& image, const std::string& name) {
  const std::vector<float> x = plane(image, name + ".X"), y = plane(image, name + ".Y"),
                           z = plane(image, name + ".Z");
  std::vector<vec3> values(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) values[i] = {x[i], y[i], z[i]};
  return values;
}

// Pixel by pixel, rows from the top. OpenGL moves vertices to a grid of 1/256 pixel: a pixel is 0.06 wide at
// the depths of this view, and positions may be off by a slope times 1/256 of that; where the two see
// different triangles, they do so beside an edge.
void expect_equal_surfaces(const std::string& more) {
  const TemporaryFolder folder;
  const char* aovs = "--aov normal,position,alpha,depth";
  const Image rays = render_with_nook(folder, write_small_scene(folder, "a.toml", traced + more), aovs);
  const Image raster =
      render_with_nook(folder, write_small_scene(folder, "b.toml", screen_space + more), aovs);
  const auto positions = vectors(rays, "P"), normals = vectors(rays, "N");
  const auto same_positions = vectors(raster, "P"), same_normals = vectors(raster, "N");
  const auto coverage = plane(raster, "A"), depth = plane(rays, "Z"), same_depth = plane(raster, "Z");
  ASSERT_EQ(positions.size(), same_positions.size());
  int surfaces = 0, edges = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const bool seen = glm::dot(normals[i], normals[i]) > 0;
    if (seen != (coverage[i] > 0) || glm::length(normals[i] - same_normals[i]) > 1e-4f) {
      ++edges;
      continue;
    }
    if (!seen) continue;
    ++surfaces;
    EXPECT_LT(glm::length(positions[i] - same_positions[i]), 5e-3f) << i % width << "," << i / width;
    EXPECT_LT(std::abs(depth[i] - same_depth[i]), 5e-3f) << i % width << "," << i / width;
  }
  EXPECT_GT(surfaces, 700);
  EXPECT_LE(edges, 6);
}

TEST(SsaoPrimaryHits, EqualTheCameraRays) {
  expect_equal_surfaces("");
}

// A ground that the scene adds below the mesh is drawn too, and occludes.
TEST(SsaoPrimaryHits, GroundIsDrawn) {
  const std::string ground = "[ground]\nheight = -0.25\n";
  expect_equal_surfaces(ground);

  const TemporaryFolder folder;
  const auto scene = write_small_scene(folder, "scene.toml", screen_space + ground);
  const Image image = render_with_nook(folder, scene, "--aov position,alpha");
  const std::vector<float> alpha = plane(image, "A"), height = plane(image, "P.Y"), ao = plane(image, "R");
  int ground_pixels = 0, occluded = 0;
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (alpha[i] == 0 || std::abs(height[i] + 0.25f) > 1e-3f) continue;
    ++ground_pixels;
    occluded += ao[i] < 0.9f;
  }
  // The floor of the mesh hangs 0.25 above the ground: beside it the ground is open, near it occluded.
  EXPECT_GT(ground_pixels, 300);
  EXPECT_GT(occluded, 20);
  EXPECT_LT(occluded, ground_pixels / 2);
}

}  // namespace
}  // namespace nook::test
