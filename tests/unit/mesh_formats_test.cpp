// What files of meshes and materials may hold beside the plain case, by kind.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <regex>

#include "base/error.hpp"
#include "mesh/load_mesh.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/mtl_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::TemporaryFolder;
using test::write_bytes;

constexpr MeshAttributes everything{.normals = true, .uvs = true, .materials = true, .groups = true};

TriangleMesh load(const std::string& name, const std::string& bytes,
                  const MeshAttributes& want = everything) {
  const TemporaryFolder folder;
  write_bytes(folder / name, bytes);
  return load_mesh(folder / name, want);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjKinds, AreTheSquare) {
  const std::string texts[] = {
      "f 1 2 \\\n3 4\n",         "f 1 2 3\\\n 4\n",           "f \\\n1 2 3 \\\n4",
      "f 1 2 3\\\n4\n",          "f 1// 2// 3// 4//\n",       "f 1/ 2/ 3/ 4/\n",
      "f -4 -3 -2 -1\n",         "\tf\t1 2\t3 4 \n",          "# C:\\\nf 1 2 3 4\n",
      "f 1 2 3 \\ \t\n4\n",      "f 1 2 \\ \n\\\n3 4 \\\n\n", "f 1/0 2/0 3/0/0 4//0\n",
      "f 1 2 3 4 # C:\\\n",      "f +1 +2 +3 +4\n",           "f 1 2 3 4\\",
      "f 1 2 3 4 \\\n\n",        "f\v1 2 3 4\nl 1 2\np 1\n",  "f 1 2 3 4\nend\n",
      "v 9 \\\n9 9\nf 1 2 3 4\n"};
  const std::string expected = mesh_hash(load("a.obj", square + "f 1 2 3 4\n"));
  for (const std::string& text : texts)
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      SCOPED_TRACE(text);
      const std::string whole = std::regex_replace(square + text, std::regex("\n"), line_end);
      for (const std::string& mark : {std::string(), std::string("\xef\xbb\xbf")}) {
        TriangleMesh mesh = load("a.obj", mark + whole);
        mesh.positions.resize(4);  // one text has a fifth
        EXPECT_EQ(mesh_hash(mesh), expected);
      }
    }
}

TEST(ObjKinds, CornersMayHaveUvsAndNoNormals) {
  const TriangleMesh mesh = load("a.obj", square + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1/ 2/2/ 3/3/\nf 1/1 3/3 4\n");
  EXPECT_EQ(mesh.triangle_uvs.size(), 2u);
  EXPECT_FALSE(mesh.has_normals());
  EXPECT_EQ(std::count(mesh.triangle_uvs[1].begin(), mesh.triangle_uvs[1].end(), TriangleMesh::no_uv), 1);
}

TEST(ObjKinds, TextureCoordinatesThatAreNoNumbers) {
  const std::string faces = "f 1/1 2/1 3/1\nf 1/2 3/2 4/1\n";
  for (const char* bad : {" nan 1", " 1 1.#QNAN00", " -1.#IND 0", " 1e39", " x 1", " 1,5 0", ""}) {
    const TriangleMesh mesh = load("a.obj", square + "vt 0 0\nvt" + bad + "\n" + faces);
    ASSERT_EQ(mesh.report.warnings.size(), 1u) << bad;
    EXPECT_NE(mesh.report.warnings[0].find("a.obj:6: texture coordinates that are no finite numbers"),
              std::string::npos);
    EXPECT_EQ(std::count(mesh.triangle_uvs[1].begin(), mesh.triangle_uvs[1].end(), TriangleMesh::no_uv), 2);
  }
  // nobody asked for them
  EXPECT_EQ(load("a.obj", square + "vt 0 0\nvt x 1\n" + faces, {}).triangles.size(), 2u);
}

TEST(ObjKinds, PositionsAndNormalsThatAreNotFiniteInAnySpelling) {
  for (const char* bad : {"nan", "-nan", "-nan(ind)", "inf", "1.#QNAN", "-1.#IND00", "1.#INF", "-1.#J"}) {
    const TriangleMesh mesh = load(
        "a.obj", square + "vn " + bad + " 0 1\nvn 0 0 1\nv 0 0 " + bad + "\nf 1//1 2//2 3//2\nf 1 2 5\n");
    EXPECT_EQ(mesh.triangles.size(), 1u) << bad;
    EXPECT_EQ(mesh.report.non_finite_dropped, 1u);
    EXPECT_EQ(mesh.report.normals_replaced, 1u);
  }
  for (const char* bad : {"1.#", "1.#-1", "2.#INF", "1#INF", "--1.#INF"})
    expect_error(ErrorKind::scene,
                 "a.obj:5: ", [&] { load("a.obj", square + "v 0 0 " + bad + "\nf 1 2 3\n"); });
}

TEST(ObjKinds, NumbersAreReadToTheLastBit) {
  const TriangleMesh mesh =
      load("a.obj", "v 16777217 0.1 1e-400\nv 1e39 +5 -.5\nv 4.00000011920929 1E+2 3.\nf 1 1 1\nf 3 3 3\n");
  // The mesh is 2^24 large, and kept in a frame of its own: exactly.
  const auto in_file = [&](std::size_t i) { return vec3(mesh.frame.to_file(dvec3(mesh.positions[i]))); };
  EXPECT_EQ(in_file(0), vec3(16777217.0, 0.1, 0));
  EXPECT_EQ(in_file(2), vec3(4.00000011920929, 100, 3));
}

TEST(ObjKinds, TextOfUtf16IsSaidToBe) {
  expect_error(ErrorKind::scene, "a.obj: the text is UTF-16: save it as UTF-8",
               [] { load("a.obj", std::string("\xff\xfev\0 \0", 6)); });
}

TEST(ObjKinds, CrossingOutlinesAreOneWarningWithTheLine) {
  const std::string bow_tie = "f 1 3 2 4\n", arrow = "v .5 .2 0\nf 1 5 3 4\n";
  TriangleMesh mesh = load("a.obj", square + arrow);
  EXPECT_TRUE(mesh.report.warnings.empty());
  mesh = load("a.obj", square + "# a\n" + bow_tie + "f 1 2 3 4\n" + bow_tie);
  ASSERT_EQ(mesh.report.warnings.size(), 1u);
  EXPECT_NE(mesh.report.warnings[0].find("a.obj:6: the face's outline crosses itself (and 1 more)"),
            std::string::npos)
      << mesh.report.warnings[0];
  EXPECT_EQ(mesh.triangles.size(), 6u);
}

TEST(ObjKinds, AFaceOfSeveralGroupsIsInEach) {
  const TriangleMesh mesh = load("a.obj", square + "g a b\nf 1 2 3\ng b\nf 1 3 4\no a b\nf 1 2 4\n");
  EXPECT_EQ(mesh.groups, (std::vector<std::string>{"a b", "b"}));
  ASSERT_EQ(mesh.group_names.size(), 2u);
  EXPECT_EQ(mesh.group_names[0], (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(mesh.triangle_group, (std::vector<std::uint32_t>{0, 1, 0}));
}

const std::string obj_of_materials =
    "mtllib a b.mtl\n" + square + "vt 0 0\nusemtl Dark  Wood \nf 1/1 2/1 3/1\nusemtl b # c\nf 1/1 3/1 4/1\n";

TriangleMesh load_with_library(const std::string& obj, const std::string& library,
                               const MeshAttributes& want = everything) {
  const TemporaryFolder folder;
  write_bytes(folder / "a b.mtl", library);
  write_bytes(folder / "A.PNG", "");
  write_bytes(folder / "a.obj", obj);
  return load_mesh(folder / "a.obj", want);
}

TEST(MtlKinds, NamesValuesAndOptions) {
  const TriangleMesh mesh = load_with_library(
      obj_of_materials,
      "\xef\xbb\xbfnewmtl Dark  Wood\r\n\tns 10 # soft\r\n\tKs 0.5 0 0 # red\r\n\tmap_D -s 2 3 1 -o .5 -mm 1 "
      "-1 "
      "-imfchan r -clamp on -bm 2 -texres 512 C:\\work maps\\a.png # holes\r\nnewmtl b\r\nNs 3\r\nKs 0\r\n");
  EXPECT_TRUE(mesh.report.warnings.empty());
  ASSERT_EQ(mesh.triangle_material, (std::vector<std::uint32_t>{0, 1}));
  const Material &wood = mesh.materials[0], &b = mesh.materials[1];
  EXPECT_EQ(wood.phong_exponent, 10);
  EXPECT_TRUE(std::filesystem::path(wood.opacity_map).filename() == "A.PNG") << wood.opacity_map;
  EXPECT_EQ(wood.map.scale, vec2(2, 3));
  EXPECT_EQ(wood.map.offset, vec2(.5, 0));
  EXPECT_EQ(wood.map.base, 1);
  EXPECT_EQ(wood.map.gain, -1);
  EXPECT_EQ(wood.map.channel, 'r');
  EXPECT_TRUE(wood.map.clamp);
  EXPECT_EQ(b.phong_exponent, -1);
}

TEST(MtlKinds, AnExponentThatNobodyReadsStopsNothing) {
  MeshAttributes with_exponents = everything;
  with_exponents.exponents = true;
  for (const char* bad : {"-1.96", "nan", "1e8", "x", "", "3 4"}) {
    const std::string library = "newmtl b\nKd 1 1 1\nNs " + std::string(bad) + "\nnewmtl Dark  Wood\n";
    EXPECT_EQ(load_with_library(obj_of_materials, library).materials[0].phong_exponent, -1);
    expect_error(ErrorKind::scene, "a b.mtl:3: Ns must be a number from 0 to 1e7",
                 [&] { load_with_library(obj_of_materials, library, with_exponents); });
    // of a material that no face has, or that has no lobe
    EXPECT_EQ(
        load_with_library(obj_of_materials, "newmtl c\nNs x\nnewmtl b\nNs x\nKs 0 0 0\n", with_exponents)
            .materials.size(),
        2u);
  }
}

TEST(MtlKinds, WhatIsMissingIsOneWarning) {
  const auto warning = [](const TriangleMesh& mesh) {
    return mesh.report.warnings.size() == 1 ? mesh.report.warnings[0]
                                            : std::to_string(mesh.report.warnings.size());
  };
  EXPECT_NE(warning(load("a.obj", obj_of_materials)).find("a.obj:1: there is no material library 'a b.mtl'"),
            std::string::npos);
  EXPECT_NE(warning(load_with_library(obj_of_materials, "newmtl b\n"))
                .find("a.obj:7: no library has the material 'Dark  Wood'"),
            std::string::npos);
  EXPECT_EQ(warning(load("a.obj", obj_of_materials, {.normals = true})), "0");  // no effect needs them
  EXPECT_EQ(warning(load("a.obj", square + "f 1 2 3\n")), "0");
}

std::string binary_stl(std::uint32_t count, const std::vector<float>& corners,
                       const std::string& header = "") {
  std::string bytes = header + std::string(80 - header.size(), '\0');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t t = 0; 9 * t < corners.size(); ++t) {
    bytes += std::string(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&corners[9 * t]), 36);
    bytes += "\1\2";
  }
  return bytes;
}

const std::string ascii_stl =
    "solid a plate\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1e0 0 0\n  vertex 1 1 -0\n "
    "endloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 +1 0\nendloop\nendfacet\n"
    "endsolid a plate\n";

TEST(Stl, BinaryAndTextShareTheirVertices) {
  const std::string binary = binary_stl(2, {0, 0, 0, 1, 0, 0, 1, 1, -0.f, 0, 0, 0, 1, 1, 0, 0, 1, 0});
  for (const std::string& bytes :
       {binary, ascii_stl, binary_stl(2, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, "solid"),
        std::regex_replace(ascii_stl, std::regex("\n"), "\r\n"),
        std::regex_replace(ascii_stl, std::regex("vertex"), "VERTEX"),
        std::regex_replace(ascii_stl, std::regex("\n"), " "), "\xef\xbb\xbf\n \t" + ascii_stl,
        std::regex_replace(ascii_stl, std::regex("0 0 1"), "nan -nan(ind) 1.#QNAN"),
        "# made by hand\n" + ascii_stl}) {
    const TriangleMesh mesh = load("plate.STL", bytes, {.normals = true});
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh_hash(mesh), mesh_hash(load("a.obj", square + "f 1 2 3\nf 1 3 4\n", {.normals = true})));
    EXPECT_TRUE(mesh.report.warnings.empty());
  }
  EXPECT_EQ(load("plate.stl", binary).groups, std::vector<std::string>{"plate"});
  EXPECT_EQ(load("plate.stl", ascii_stl + "solid\n" + ascii_stl.substr(14)).groups,
            (std::vector<std::string>{"a plate", "plate"}));
  // of one line: what the name is ends with the first facet, and nothing behind endsolid is lost
  const TriangleMesh two =
      load("a.stl", std::regex_replace(ascii_stl + ascii_stl, std::regex("\n"), " "), {.groups = true});
  EXPECT_EQ(two.triangles.size(), 4u);
  EXPECT_EQ(two.groups, std::vector<std::string>{"a plate"});
}

TEST(Stl, BinaryHeadsMayBeginWithSolid) {
  const std::vector<float> corners = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  for (const std::string& head : {std::string("solid"), std::string("Solid a.stl") + std::string(69, ' '),
                                  std::string("solid facet normal outer loop vertex")}) {
    const std::string bytes = binary_stl(1, corners, head);
    EXPECT_EQ(load("a.stl", bytes).triangles.size(), 1u);
    const TriangleMesh more = load("a.stl", bytes + "more");
    EXPECT_EQ(more.triangles.size(), 1u);
    ASSERT_EQ(more.report.warnings.size(), 1u);
    EXPECT_NE(more.report.warnings[0].find("4 bytes behind the last triangle are left out"),
              std::string::npos);
    expect_error(ErrorKind::scene, "a.stl: the file ends too early: 124 bytes, its 1 triangles take 134",
                 [&] { load("a.stl", bytes.substr(0, 124)); });
  }
}

TEST(Stl, BadFilesSayWhere) {
  const auto refuse = [](const std::string& bytes, const std::string& message) {
    expect_error(ErrorKind::scene, message, [&] { load("a.stl", bytes); });
  };
  refuse("", "a.stl: neither an ASCII STL file nor as long as a binary one's header");
  refuse("solid a\nendsolid a\n", "a.stl: the mesh has no triangles");
  refuse(binary_stl(3, {0, 0, 0, 1, 0, 0, 1, 1, 0}),
         "a.stl: the file ends too early: 134 bytes, its 3 triangles take 234");
  refuse(binary_stl(0, {}), "the mesh has no triangles");
  refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "a.stl:4: 2 numbers, expected 3");
  refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", "a.stl:4: 'x' is not a number");
  refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nendloop\n", "a.stl:5: a facet of 1 corners");
  refuse("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\n", "a.stl:4: the file ends within a facet");
  refuse("solid a\nvortex\n", "a.stl:2: unknown word 'vortex'");
  const TriangleMesh cut = load("a.stl", ascii_stl.substr(0, ascii_stl.find("endsolid")));
  ASSERT_EQ(cut.report.warnings.size(), 1u);
  EXPECT_NE(cut.report.warnings[0].find("ends without endsolid"), std::string::npos);
}

std::string gzipped(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY);
  std::string out(text.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = uInt(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

TEST(MeshFormats, CompressedFilesAndNamesOfAnyCase) {
  std::string text = square + "f 1 2 3 4\n";
  const std::string expected = mesh_hash(load("a.obj", text));
  EXPECT_EQ(mesh_hash(load("a.OBJ", text)), expected);
  EXPECT_EQ(mesh_hash(load("a.obj.gz", gzipped(text))), expected);
  EXPECT_EQ(mesh_hash(load("a.Obj.GZ", gzipped(text))), expected);
  EXPECT_EQ(load("a.stl.gz", gzipped(ascii_stl)).triangles.size(), 2u);
  for (int i = 0; i < 200000; ++i) text += "# a comment that compresses well\n";
  EXPECT_EQ(mesh_hash(load("a.obj.gz", gzipped(text))), expected);
  const std::string bytes = gzipped(square + "f 1 2 3 4\n");
  expect_error(ErrorKind::scene, "a.obj.gz: the compressed file ends too early",
               [&] { load("a.obj.gz", bytes.substr(0, bytes.size() - 9)); });
  std::string damaged = bytes;
  damaged[bytes.size() - 6] = char(damaged[bytes.size() - 6] ^ 1);
  expect_error(ErrorKind::scene, "a.obj.gz: is damaged", [&] { load("a.obj.gz", damaged); });
  expect_error(ErrorKind::scene, "a.obj.gz: is not compressed by gzip", [&] { load("a.obj.gz", square); });
}

TEST(MeshFormats, OthersAreNamed) {
  for (const char* name : {"cube.fbx", "cube.GLB", "cube", "cube.obj.zip", "cube.gz", "cube.fbx.gz"})
    expect_error(ErrorKind::scene, std::string(name) + ": not a format that nook reads (OBJ, PLY, STL)",
                 [&] { load(name, square); });
  for (const char* name : {"a.fbx", "a.Gltf", "a.toml.gz", "a.fbx.gz"})
    EXPECT_TRUE(is_unread_mesh(name) && !is_mesh(name)) << name;
  for (const char* name : {"a.OBJ", "a.ply.GZ", "a.stl", "a.obj.gz"})
    EXPECT_TRUE(is_mesh(name) && !is_unread_mesh(name)) << name;
  for (const char* name : {"scene.toml", "scene", "picture.exr"})
    EXPECT_FALSE(is_mesh(name) || is_unread_mesh(name)) << name;
  expect_error(ErrorKind::scene, "none.fbx: no such file", [] { load_mesh("none.fbx"); });
}

template <class T>
void put(std::string& out, T value, bool big) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big) std::reverse(bytes, bytes + sizeof(T));
  out.append(bytes, sizeof(T));
}

// A square of four corners and their uv, then a strip: in each of PLY's formats, with all kinds of numbers.
std::string ply(const std::string& format, const std::string& line_end) {
  const std::string header =
      " ply \nformat  " + format +
      "\t1.0\n comment\nelement vertex 4\nproperty double x\nproperty float y\nproperty int16 z"
      "\nproperty list uint8 int64 nothing\nproperty uint64 u\nproperty int8 v\nelement face 1\n"
      "property list int64 uint64 vertex_indices\nelement tristrips 1\nproperty list int int "
      "vertex_indices \nend_header \n";
  std::string out = std::regex_replace(header, std::regex("\n"), line_end);
  const bool text = format == "ascii", big = format == "binary_big_endian";
  const int corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& [x, y] : corners)
    if (text) {
      out += "+" + std::to_string(x) + " " + std::to_string(y) + ".0 +0 2 7 8 " + std::to_string(x) + " " +
             std::to_string(y) + line_end;
    } else {
      put(out, double(x), big);
      put(out, float(y), big);
      put(out, std::int16_t(0), big);
      put(out, std::uint8_t(1), big);
      put(out, std::int64_t(7), big);
      put(out, std::uint64_t(x), big);
      put(out, std::int8_t(y), big);
    }
  if (text) return out + "4 0 1 2 3" + line_end + "9 0 1 2 -1 0 1 3 3 2" + line_end;
  put(out, std::int64_t(4), big);
  for (std::uint64_t i = 0; i < 4; ++i) put(out, i, big);
  put(out, 9, big);
  for (const int i : {0, 1, 2, -1, 0, 1, 3, 3, 2}) put(out, i, big);
  return out;
}

TEST(PlyKinds, FormatsLineEndsBlanksSignsTypesStrips) {
  const std::string expected = mesh_hash(load("a.ply", ply("ascii", "\n")));
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      SCOPED_TRACE(format);
      const TriangleMesh mesh = load("a.PLY", ply(format, line_end));
      EXPECT_EQ(mesh_hash(mesh), expected);
      ASSERT_EQ(mesh.triangles.size(),
                4u);  // two of the square, two of strips: (0 1 3 3 2) has two flat ones
      EXPECT_EQ(mesh.uvs, (std::vector<vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
      EXPECT_EQ(mesh.triangle_uvs, mesh.triangles);
    }
}

TEST(PlyKinds, StripsTurnEveryOtherTriangle) {
  const TriangleMesh mesh =
      load("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n0 1 0\n1 0 0\n1 1 "
           "0\n2 0 0\n2 1 0\n"
           "6 1 0 3 2 5 4\n");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (const auto& t : mesh.triangles) {
    const vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    EXPECT_GT(glm::cross(b - a, c - a).z, 0);
  }
}

TEST(PlyKinds, NamesOfAnyCaseByteOrderMarksAndStripsWithoutSigns) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement Vertex 4\nproperty float X\nproperty float Y\nproperty float Z\n";
  const std::string corners = "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto triangles = [&](const std::string& element, const std::string& list) {
    return load("a.ply", "\xef\xbb\xbf" + head + element + corners + list).triangles;
  };
  const auto expected =
      triangles("element face 2\nproperty list uchar int vertex_index\n", "3 0 1 2\n3 0 1 3\n");
  EXPECT_EQ(expected.size(), 2u);
  EXPECT_EQ(triangles("element Face 2\nproperty list uchar int Vertex_Indices\n", "3 0 1 2\n3 0 1 3\n"),
            expected);
  EXPECT_EQ(
      triangles("element tristrips 1\nproperty list uchar uint vertex_index\n", "7 0 1 2 4294967295 0 1 3\n"),
      expected);
  expect_error(ErrorKind::scene, "a.ply:13: faces need the list vertex_indices",
               [&] { triangles("element face 1\nproperty list uchar int corners\n", "3 0 1 2\n"); });
}

TEST(PlyKinds, AHeaderLineWithTheOtherLineEndIsQuotedInOneLine) {
  for (const char* line : {"what\never", "format a\nb", "element vertex 1\rproperty f\nl x"}) try {
      load("a.ply", std::string("ply\r") + line + "\rend_header\r");
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST(PlyKinds, CornersOwnTextureCoordinates) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float "
      "s\nproperty float t\nelement face 2\nproperty list uchar float texcoord\nproperty list uchar int "
      "vertex_index\nend_header\n0 0 0 .1 .2\n1 0 0 .3 .4\n1 1 0 .5 .6\n0 1 0 .7 .8\n";
  const TriangleMesh mesh = load("a.ply", head + "6 0 0 1 0 1 1 3 0 1 2\n0 3 0 2 3\n");
  ASSERT_EQ(mesh.triangle_uvs.size(), 2u);
  const auto uv_of = [&](std::size_t t, std::uint32_t vertex) {
    const std::size_t k = std::size_t(std::find(mesh.triangles[t].begin(), mesh.triangles[t].end(), vertex) -
                                      mesh.triangles[t].begin());
    return mesh.uvs[mesh.triangle_uvs[t][k]];
  };
  EXPECT_EQ(uv_of(0, 2), vec2(1, 1));
  EXPECT_EQ(uv_of(1, 2), vec2(.5f, .6f));
}

TEST(PlyKinds, IndicesAreIntegersOfTheFile) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face "
      "1\nproperty list uchar float vertex_index\nend_header\n0 0 0\n1 0 0\n1 1 0\n";
  EXPECT_EQ(load("a.ply", head + "3 0 1 2.0\n").triangles.size(), 1u);
  expect_error(ErrorKind::scene, "a.ply:13: vertex index 1.5 is not an integer",
               [&] { load("a.ply", head + "3 0 1 1.5\n"); });
}

// The same faces of many corners in OBJ and PLY are the same triangles.
TEST(MeshFormats, TheSameFacesAreTheSameMesh) {
  const std::string corners[] = {".1 0 .3",  "4.3 .2 .1",  "4.1 1.7 .4", "1.2 1.1 .2", "1.3 2.1 .3",
                                 "3 2.2 .1", "3.1 3.3 .1", "1.1 3 .2",   "1 5.1 .3",   "0 5 .1"};
  std::string obj, body;
  for (const std::string& corner : corners) {
    obj += "v " + corner + "\n";
    body += corner + "\n";
  }
  for (const char* type : {"float", "double"}) {
    std::string head = "ply\nformat ascii 1.0\nelement vertex 10\n";
    for (const char* axis : {"x", "y", "z"}) head += std::string("property ") + type + " " + axis + "\n";
    head += "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    const TriangleMesh a = load("a.obj", obj + "f 1 2 3 4 5 6 7 8 9 10\nf 1 2 4 5\nf 9 8 7 6 5\n",
                                {.normals = true}),
                       b = load("a.ply", head + body + "10 0 1 2 3 4 5 6 7 8 9\n4 0 1 3 4\n5 8 7 6 5 4\n",
                                {.normals = true});
    EXPECT_EQ(a.triangles.size(), 13u);
    EXPECT_EQ(mesh_hash(a), mesh_hash(b));
  }
}

}  // namespace
}  // namespace nook
