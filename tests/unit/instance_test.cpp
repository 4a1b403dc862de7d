// Instances are copies; several mesh files are one scene; the ground is a plane below.
#include "mesh/instance.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "mesh/mesh_analysis.hpp"
#include "plan/plan.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/scene_toml.hpp"
#include "support/expect_error.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

TriangleMesh load(const TemporaryFolder& folder, const std::string& input,
                  const MeshAttributes& attributes = {}) {
  write_bytes(folder / "scene.toml", input + small_view);
  return load_scene_mesh(load_scene(folder / "scene.toml"), attributes);
}

const std::string one = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
// `one` scaled by (2, 4, 1), then moved by (3, 0, -1): exact in floats.
const std::string baked = one + "v 3 0 -1\nv 5 0 -1\nv 3 4 -1\nvn 0 0 1\nf 4//2 5//2 6//2\n";

TEST(Instances, AreTheirBakedCopiesToTheBit) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  write_bytes(folder / "baked.obj", baked);
  const TriangleMesh copies = load(folder,
                                   "[input]\nobjfile = \"one.obj\"\n[[instance]]\nobjfile = "
                                   "\"one.obj\"\nscale = [2, 4, 1]\ntranslate = [3, 0, -1]\n");
  const TriangleMesh by_hand = load(folder, "[input]\nobjfile = \"baked.obj\"\n");
  EXPECT_EQ(mesh_hash(copies), mesh_hash(by_hand));
  EXPECT_EQ(copies.bounds.hi, by_hand.bounds.hi);
}

TEST(Instances, RenderAsTheirBakedCopies) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  write_bytes(folder / "baked.obj", baked);
  const std::string rest = std::string(small_view) + "[renderer]\nspp = 4\nmax_distance = 3\n";
  write_bytes(folder / "a.toml",
              "[[instance]]\nobjfile = \"one.obj\"\n[[instance]]\nobjfile = \"one.obj\"\nscale = [2, 4, "
              "1]\ntranslate = [3, 0, -1]\n" +
                  rest);
  write_bytes(folder / "b.toml", "[input]\nobjfile = \"baked.obj\"\n" + rest);
  EXPECT_EQ(plane(render_with_nook(folder, folder / "a.toml"), "R"),
            plane(render_with_nook(folder, folder / "b.toml"), "R"));
}

// Mirrored by scale -1: the winding turns with it, so that the geometric normal is the transformed vertex
// normal.
TEST(Instances, MirrorsKeepTheirSides) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  const TriangleMesh mesh =
      load(folder, "[[instance]]\nobjfile = \"one.obj\"\nscale = [-1, 1, 1]\nrotate = [0, 90, 0]\n");
  const auto& t = mesh.triangles[0];
  const vec3 geometric =
      glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
  EXPECT_GT(glm::dot(geometric, mesh.normals[mesh.triangle_normals[0][0]]), 0.99f);
  EXPECT_NEAR(mesh.normals[mesh.triangle_normals[0][0]].x, 1, 1e-6);
}

TEST(Instances, FilesWithAndWithoutNormalsMix) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  write_bytes(folder / "two.obj", "v 0 0 3\nv 1 0 3\nv 0 1 3\nf 1 2 3\n");
  const TriangleMesh mesh = load(folder, "[input]\nobjfile = [\"two.obj\", \"one.obj\"]\n");
  ASSERT_EQ(mesh.triangle_normals.size(), 2u);
  EXPECT_EQ(mesh.triangle_normals[0][0], TriangleMesh::no_normal);
  EXPECT_EQ(mesh.triangle_normals[1][0], 0u);
}

TEST(Ground, LiesUnderTheMeshAndLeavesTheDistanceAlone) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  const TriangleMesh bare = load(folder, "[input]\nobjfile = \"one.obj\"\n"),
                     grounded = load(folder, "[input]\nobjfile = \"one.obj\"\n[ground]\n");
  EXPECT_EQ(grounded.triangles.size(), bare.triangles.size() + 2);
  EXPECT_EQ(grounded.bounds.lo.y, bare.bounds.lo.y);
  EXPECT_LT(grounded.bounds.lo.x, -10);
  Effect ao;
  EXPECT_EQ(resolve_distance(ao, subject_radius(grounded), false),
            resolve_distance(ao, subject_radius(bare), false));
  const TriangleMesh lower =
      load(folder, "[input]\nobjfile = \"one.obj\"\n[ground]\nheight = -2\nreach = 3\n");
  EXPECT_EQ(lower.bounds.lo.y, -2);
  EXPECT_EQ(lower.bounds.hi.x, 3.5f);
}

TEST(Instances, BadOnesSayWhere) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.obj", one);
  const auto refuse = [&](const std::string& input, const std::string& message) {
    expect_error(ErrorKind::scene, message, [&] { load(folder, input); });
  };
  refuse("[[instance]]\ntranslate = [1, 2, 3]\n", "scene.toml:1:1: objfile is missing in [[instance]]");
  refuse("[[instance]]\nobjfile = \"one.obj\"\nscale = 0\n",
         "scene.toml:3:9: scale must be a number other than 0, or three");
  refuse("[[instance]]\nobjfile = \"one.obj\"\nrotation = 3\n", "did you mean 'rotate'?");
  refuse("[[instance]]\nobjfile = \"none.obj\"\n", "none.obj: no such file");
  write_bytes(folder / "big.obj", "v 0 0 0\nv 1e20 0 0\nv 0 1e20 0\nf 1 2 3\n");
  refuse("[[instance]]\nobjfile = \"big.obj\"\nscale = 1e30\n", "beyond the range of floats");
  refuse("[input]\nobjfile = []\n", "objfile must be the name of a mesh, or a list of names");
  refuse("[input]\nobjfile = [3]\n", "objfile must be the name of a mesh, or a list of names");
  refuse("instance = 3\n[input]\nobjfile = \"one.obj\"\n", "instances are tables: [[instance]]");
  refuse("[input]\nobjfile = \"one.obj\"\n[ground]\nheight = \"low\"\n",
         "height must be a number, \"auto\", or \"none\"");
}

}  // namespace
}  // namespace nook::test
