// Baking to vertices is estimating at their positions with their normals: what nook probe does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "mesh/ply.hpp"
#include "points/vertex_points.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

// Property `name` of each vertex of a PLY as write_ply makes them.
std::vector<float> property(const std::string& bytes, const std::string& name, std::size_t vertices) {
  const std::size_t end = bytes.find("end_header\n");
  std::istringstream header(bytes.substr(0, end));
  int count = 0, place = -1;
  for (std::string line; std::getline(header, line);) {
    if (line == "property float " + name) place = count;
    count += line.starts_with("property float ");
  }
  EXPECT_GE(place, 0) << name;
  std::vector<float> values(vertices);
  for (std::size_t i = 0; place >= 0 && i < vertices; ++i)
    std::memcpy(&values[i], bytes.data() + end + 11 + (i * std::size_t(count) + std::size_t(place)) * 4, 4);
  return values;
}

TEST(Bake, VerticesAreProbes) {
  const TemporaryFolder folder;
  const auto scene = write_small_scene(
      folder, "bake.toml",
      "[renderer]\nspp = 4\ndirections = 256\n[[effect]]\ntype = \"ao\"\n[[effect]]\ntype = \"bent\"\n");
  const auto output = folder / "baked.ply";
  const ProgramResult baked =
      run_nook(folder, "bake '" + scene.string() + "' --to vertices -o '" + output.string() + "'");
  ASSERT_EQ(baked.code, 0) << baked.err;
  const TriangleMesh mesh = load_ply(output);
  const std::string bytes = read_bytes(output);
  const std::vector<float> ao = property(bytes, "ao", mesh.positions.size()),
                           same = property(bytes, "bent_ao", mesh.positions.size());
  EXPECT_EQ(ao, same);

  std::ostringstream csv;
  csv.precision(9);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i], n = mesh.normals[i];
    csv << p.x << ',' << p.y << ',' << p.z << ',' << n.x << ',' << n.y << ',' << n.z << '\n';
  }
  write_bytes(folder / "points.csv", csv.str());
  const auto single = write_small_scene(folder, "probe.toml", "[renderer]\ntype = \"ao\"\n");
  const ProgramResult probed = run_nook(folder, "probe '" + single.string() + "' --samples 1024 --points '" +
                                                    (folder / "points.csv").string() + "'");
  ASSERT_EQ(probed.code, 0) << probed.err;
  std::istringstream rows(probed.out);
  std::string line;
  std::getline(rows, line);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    ASSERT_TRUE(std::getline(rows, line));
    // Normals may differ in their last bit: a direction or two may change its mind.
    EXPECT_NEAR(ao[i], std::stof(line), 3.0 / 1024) << i;
  }
  // The wall's upper corners (vertices 4 and 5) look into the open: more light than where the wall meets the
  // floor (0 and 1).
  EXPECT_GT(ao[4], ao[0]);
  EXPECT_LT(ao[0], 0.95f);
}

TEST(Bake, NormalsOfACubeCornerAreItsDiagonal) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
  const std::vector<vec3> normals = position_normals(mesh);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(normals[0][axis], -1 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(normals[4], vec3(0));
  EXPECT_EQ(vertex_points(mesh, normals)[4].flags, 0u);
}

TEST(Bake, RefusesWhatNeedsAViewer) {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& keys, const std::string& message) {
    const auto scene = write_small_scene(folder, "s.toml", "[renderer]\n" + keys);
    const ProgramResult run =
        run_nook(folder, "bake '" + scene.string() + "' -o '" + (folder / "x.ply").string() + "'");
    EXPECT_EQ(run.code, 3);
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.ply"));
  };
  refuse("type = \"ro\"\n", "needs an effect of type ao or bent");
  refuse("type = \"bent\"\nspace = \"view\"\n", "a bake has no viewer");
  refuse("type = \"ao\"\nside = \"viewer\"\n", "a bake has no viewer");
}

}  // namespace
}  // namespace nook::test
