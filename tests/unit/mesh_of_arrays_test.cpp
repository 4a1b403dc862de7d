// A mesh from arrays is the mesh that a file with the same numbers gives, and wrong arrays are named.
#include "mesh/mesh_of_arrays.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesh/load_mesh.hpp"
#include "mesh/mesh_analysis.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;

const std::vector<float> square = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0.5f};
const std::vector<std::uint32_t> two = {0, 1, 2, 0, 2, 3};

TEST(MeshOfArrays, IsTheFilesMesh) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "square.obj",
                    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0.5\nvn 0 0 3\nvn 0 1 1\nvn 1 0 0\nvn 0 0 0\n"
                    "f 1//1 2//2 3//3\nf 1//1 3//3 4//4\n");
  const std::vector<float> normals = {0, 0, 3, 0, 1, 1, 1, 0, 0, 0, 0, 0};
  EXPECT_EQ(mesh_hash(mesh_of_arrays(square, two)),
            mesh_hash(load_mesh(folder / "square.obj", {.normals = false})));
  const TriangleMesh with = mesh_of_arrays(square, two, normals), file = load_mesh(folder / "square.obj", {});
  EXPECT_EQ(with.triangles, file.triangles);
  ASSERT_TRUE(with.has_normals());
  for (std::size_t t = 0; t < with.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = with.triangle_normals[t][k], b = file.triangle_normals[t][k];
      ASSERT_EQ(a == TriangleMesh::no_normal, b == TriangleMesh::no_normal);
      if (a == TriangleMesh::no_normal) continue;
      EXPECT_EQ(with.normals[a], file.normals[b]);
    }
}

// Doubles on a map are rounded after they are moved near 0: the same floats as of the mesh at 0.
TEST(MeshOfArrays, KeepsTheDigitsOfDoubles) {
  const std::vector<double> near(square.begin(), square.end());
  std::vector<double> far = near;
  for (double& x : far) x += 1 << 20;
  const TriangleMesh at_0 = mesh_of_arrays(near, two), on_map = mesh_of_arrays(far, two);
  EXPECT_EQ(at_0.frame, Frame());
  ASSERT_NE(on_map.frame, Frame());
  for (std::size_t i = 0; i < at_0.positions.size(); ++i)
    EXPECT_EQ(on_map.frame.to_file(dvec3(on_map.positions[i])), dvec3(at_0.positions[i]) + dvec3(1 << 20));
}

TEST(MeshOfArrays, NamesWhatIsWrong) {
  const auto rejects = [](const std::string& part, const std::vector<float>& positions,
                          const std::vector<std::uint32_t>& triangles,
                          const std::vector<float>& normals = {}) {
    expect_error(ErrorKind::scene, part, [&] { mesh_of_arrays(positions, triangles, normals); });
  };
  rejects("positions: 4 numbers", {0, 0, 0, 1}, two);
  std::vector<float> nan = square;
  nan[7] = std::numeric_limits<float>::quiet_NaN();
  rejects("positions: row 2 is not finite", nan, two);
  rejects("triangles: 5 indices", square, {0, 1, 2, 0, 2});
  rejects("triangles: 0 indices", square, {});
  rejects("triangles: row 1 names vertex 4 of 4", square, {0, 1, 2, 0, 2, 4});
  rejects("normals: 1 vertices, and 4 positions", square, two, {0, 0, 1});
}

}  // namespace
}  // namespace nook
