#include "mesh/ply.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "mesh/load_mesh.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::TemporaryFolder;
using test::write_bytes;

const std::string text_header =
    "ply\nformat ascii 1.0\ncomment two triangles\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement face 1\nproperty list uchar int "
    "vertex_indices\nend_header\n";
const std::string text_body = "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0.5 255\n4 0 1 2 3\n";

TriangleMesh load(const std::string& bytes) {
  const TemporaryFolder folder;
  write_bytes(folder / "mesh.ply", bytes);
  return load_mesh(folder / "mesh.ply");
}

TEST(Ply, TextPolygonsAreCut) {
  const TriangleMesh mesh = load(text_header + text_body);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{2, 3, 0}));  // (0, 2, 3), its longest edge last
  EXPECT_EQ(mesh.positions[3], vec3(0, 1, 0.5f));
  EXPECT_EQ(mesh.bounds.hi, vec3(1, 1, 0.5f));
  EXPECT_FALSE(mesh.has_normals());
}

TEST(Ply, WhatIsWrittenIsReadBack) {
  const TemporaryFolder folder;
  TriangleMesh mesh = load(text_header + text_body);
  const std::vector<vec3> normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  const std::vector<VertexProperty> properties = {{"ao", {0.25f, 0.5f, 0.75f, 1}}};
  write_ply(folder / "out.ply", mesh, normals, properties);
  const TriangleMesh again = load_ply(folder / "out.ply");
  EXPECT_EQ(again.positions, mesh.positions);
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.normals, normals);
  const std::string bytes = test::read_bytes(folder / "out.ply");
  float value = 0;
  const std::size_t body = bytes.find("end_header\n") + 11;
  std::memcpy(&value, bytes.data() + body + 7 * 4 + 6 * 4, 4);  // the seventh number of the second vertex
  EXPECT_EQ(value, 0.5f);
  EXPECT_NE(bytes.find("property float ao\n"), std::string::npos);
}

// Steps of 1/64 at 3 948 996, where floats are 1/4 apart: doubles hold them, and only there are any written.
TEST(Ply, MapCoordinatesAreWrittenAsDoubles) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& x) {
    const TriangleMesh mesh = load(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
        x + ".015625 10 0\n" + x + ".5 10 0\n" + x + " 11 0\n3 0 1 2\n");
    write_ply(folder / "out.ply", mesh, std::vector<vec3>(3, vec3(0, 0, 1)), {});
    return test::read_bytes(folder / "out.ply");
  };
  const std::string far = written("3948996"), near = written("7");
  EXPECT_NE(far.find("property double x\nproperty double y\nproperty double z\nproperty float nx\n"),
            std::string::npos);
  double first[3];
  std::memcpy(first, far.data() + far.find("end_header\n") + 11, sizeof first);
  EXPECT_EQ(first[0], 3948996.015625);
  EXPECT_EQ(first[1], 10);
  EXPECT_NE(near.find("property float x\n"), std::string::npos);
}

TEST(Ply, BadFilesSayWhere) {
  const auto refuse = [](const std::string& bytes, const std::string& message) {
    expect_error(ErrorKind::scene, message, [&] { load(bytes); });
  };
  refuse("", "no end_header");
  refuse("obj\nend_header\n", "mesh.ply:1: not a PLY file");
  refuse("ply\nend_header\n", "has no format");
  refuse("ply\nformat binary_pdp_endian 1.0\nend_header\n",
         "mesh.ply:2: format 'binary_pdp_endian' is not ascii, binary_little_endian or binary_big_endian");
  refuse("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n",
         "mesh.ply:3: an element needs a name and a count");
  refuse("ply\nformat ascii 1.0\nelement vertex 1\nproperty float16 x\nend_header\n",
         "mesh.ply:4: unknown type 'float16'");
  refuse("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "a property before any element");
  refuse(
      "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n",
      "more than the file holds");
  refuse("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n",
         "vertices need the properties x, y and z");
  refuse(text_header + "0 0 0 255\n1 0 zero 255\n", "mesh.ply:13: 'zero' is not a number");
  refuse(text_header + "0 0 0 255\n", "the file ends too early");
  refuse(text_header + text_body.substr(0, text_body.size() - 2) + "9\n",
         "vertex index 9 is out of range (4 vertices)");
  refuse(text_header + text_body.substr(0, text_body.size() - 2) + "-1\n", "vertex index -1 is out of range");
  refuse(
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n",
      "the mesh has no triangles");
  refuse(
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int "
      "vertex_indices\nend_header\n\xff\xff\xff\xff",
      "more than the file holds");
}

}  // namespace
}  // namespace nook
