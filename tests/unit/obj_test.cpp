// What a Wavefront OBJ file may hold that is no picture's: bad numbers, and names that lead elsewhere.
#include "mesh/obj_loader.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::TemporaryFolder;
using test::write_bytes;

constexpr MeshAttributes with_materials{.normals = true, .uvs = false, .materials = true, .groups = false};

TriangleMesh load(const std::string& text) {
  const TemporaryFolder folder;
  write_bytes(folder / "mesh.obj", text);
  return load_obj(folder / "mesh.obj");
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, TrianglesOfBadVerticesAreDroppedAndCounted) {
  for (const char* bad : {"nan 0 0", "0 inf 0", "0 0 -inf", "1e39 0 0", "0 -NaN 0"}) {
    const TriangleMesh mesh = load(square + "v " + bad + "\nf 1 2 3\nf 1 2 5\nf 3 4 5\nf 1 3 4\n");
    EXPECT_EQ(mesh.report.triangles_read, 4u) << bad;
    EXPECT_EQ(mesh.report.non_finite_dropped, 2u) << bad;
    EXPECT_EQ(mesh.triangles.size(), 2u) << bad;
    EXPECT_EQ(mesh.bounds.hi, vec3(1, 1, 0)) << bad;
  }
}

TEST(Obj, NormalsThatAreNoneAreReplacedAndCounted) {
  for (const char* bad : {"0 0 0", "nan 0 1", "0 inf 0", "0 0 1e39", "1e-40 0 0"}) {
    const TriangleMesh mesh = load(square + "vn 0 0 1\nvn " + bad + "\nf 1//1 2//1 3//1\nf 1//1 3//2 4//2\n");
    EXPECT_EQ(mesh.report.normals_replaced, 2u) << bad;
    EXPECT_EQ(mesh.triangle_normals[0][0], 0u) << bad;
    EXPECT_EQ(mesh.triangle_normals[1][1], TriangleMesh::no_normal) << bad;
  }
}

TEST(Obj, NormalsOfOtherLengthsAreNormalisedAndCounted) {
  const TriangleMesh mesh = load(
      square + "vn 0 0 1\nvn 0 0 7\nvn 3e-15 0 4e-15\nvn 0 -3e30 4e30\nf 1//1 2//2 3//3\nf 1//4 3//1 4//1\n");
  EXPECT_EQ(mesh.report.normals_normalised, 3u);
  EXPECT_EQ(mesh.normals[1], vec3(0, 0, 1));
  EXPECT_NEAR(mesh.normals[2].x, 0.6f, 1e-6f);
  EXPECT_NEAR(mesh.normals[3].y, -0.6f, 1e-6f);
}

// A material library is read if it is a regular file; whatever else its name leads to is left alone, without
// waiting for it and without an error: materials are optional.
TEST(Obj, MaterialLibrariesThatAreNoFilesAreLeftUnread) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.mtl");
  ASSERT_EQ(::mkfifo((folder / "pipe.mtl").c_str(), 0600), 0);
  const std::string names[] = {
      "folder.mtl", "pipe.mtl", "/dev/zero", ".", std::string(5000, 'm'), "../../../../../../etc/none.mtl"};
  for (const std::string& name : names) {
    write_bytes(folder / "mesh.obj", "mtllib " + name + "\n" + square + "usemtl red\nf 1 2 3\n");
    const TriangleMesh mesh = load_obj(folder / "mesh.obj", with_materials);
    EXPECT_EQ(mesh.triangles.size(), 1u) << name;
  }
}

TEST(Obj, MaterialLibrariesOfBlanksUtf8AndOtherFolders) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "other");
  const std::string name = "Stoff \xc3\xa4.mtl";
  for (const std::string& place : {std::string("stoff.mtl"), "other/" + name, name}) {
    write_bytes(folder / place, "newmtl shiny\nNs 30\nKs 1 1 1\n");
    write_bytes(folder / "mesh.obj", "mtllib " + place + "\n" + square + "usemtl shiny\nf 1 2 3\n");
    const TriangleMesh mesh = load_obj(folder / "mesh.obj", with_materials);
    ASSERT_EQ(mesh.triangle_material.size(), 1u) << place;
    EXPECT_EQ(mesh.materials[mesh.triangle_material[0]].phong_exponent, 30) << place;
  }
}

TEST(Obj, EachLibraryOfALineAndOfOtherLines) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.mtl", "newmtl red\nNs 1\n");
  write_bytes(folder / "b.mtl", "newmtl green\nNs 2\nnewmtl red\nNs 3\n");
  write_bytes(folder / "c.mtl", "newmtl blue\nNs 4\n");
  write_bytes(folder / "mesh.obj",
              square +
                  "mtllib a.mtl none.mtl  b.mtl\nusemtl blue\nf 1 2 3\nusemtl red\nf 1 3 4\n"
                  "usemtl green\nf 1 2 4\nmtllib c.mtl\nmtllib a.mtl\n");
  for (const std::size_t piece_bytes : {1u, 1u << 21}) {
    const TriangleMesh mesh = load_obj(folder / "mesh.obj", with_materials, piece_bytes);
    ASSERT_EQ(mesh.materials.size(), 4u);
    std::vector<float> exponents;
    for (const std::uint32_t m : mesh.triangle_material)
      exponents.push_back(mesh.materials.at(m).phong_exponent);
    EXPECT_EQ(exponents, (std::vector<float>{4, 1, 2}));
  }
}

TEST(Obj, ALibraryOfBinaryNoiseIsNoCrash) {
  const TemporaryFolder folder;
  std::string noise;
  for (int i = 0; i < 4000; ++i) noise += char(i * 7919 % 256);
  write_bytes(folder / "noise.mtl", noise);
  write_bytes(folder / "mesh.obj", "mtllib noise.mtl\n" + square + "f 1 2 3\n");
  EXPECT_EQ(load_obj(folder / "mesh.obj", with_materials).triangles.size(), 1u);
}

}  // namespace
}  // namespace nook
