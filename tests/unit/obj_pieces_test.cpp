// An OBJ file read in pieces is the mesh that tinyobjloader reads as a whole, whatever the pieces.
#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <regex>
#include <sstream>

#include "mesh/corner_order.hpp"
#include "mesh/face_cut.hpp"
#include "mesh/obj_loader.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::TemporaryFolder;
using test::write_bytes;

constexpr MeshAttributes everything{.normals = true, .uvs = true, .materials = true, .groups = true};

// Each line that an OBJ file may have, in any order: faces of two to nine corners (the larger ones stars, so
// that they are concave; some with a vertex of another face, or one that is not finite), whose indices count
// from the beginning or back; groups that are continued, materials that no library has, comments, blank
// lines.
class RandomObj {
 public:
  explicit RandomObj(unsigned seed, const std::string& line_end) : random_(seed), end_(line_end) {
    text_ << "# written by a test" << end_ << "mtllib a.mtl" << end_;
    for (int i = 0; i < 400; ++i) line();
    text_ << "mtllib a.mtl";
  }
  std::string text() const { return text_.str(); }
  const std::vector<std::size_t>& non_finite() const { return non_finite_; }

 private:
  int upto(int most) { return std::uniform_int_distribution<int>(1, most)(random_); }
  double real() { return std::uniform_real_distribution<double>(-2, 2)(random_); }

  int index(int count) { return upto(2) == 1 ? upto(count) : -upto(count); }

  void face() {
    const int sizes[] = {2, 3, 3, 3, 4, 4, 5, 6, 9};
    const int size = sizes[upto(9) - 1];
    for (int k = 0; k < size; ++k) {
      const double angle = 2 * M_PI * k / size, radius = .3 + std::abs(real());
      text_ << "v " << radius * std::cos(angle) << "  " << radius * std::sin(angle) << '\t';
      if (upto(60) == 1) {
        text_ << (upto(2) == 1 ? "nan" : "-INF") << end_;
        non_finite_.push_back(std::size_t(positions_));
      } else {
        text_ << .1 * real() << end_;
      }
      ++positions_;
    }
    const bool has_uvs = uvs_ > 0 && upto(2) == 1, has_normals = normals_ > 0 && upto(2) == 1;
    const bool back = upto(2) == 1;
    text_ << (upto(5) == 1 ? " f" : "f");
    for (int k = 0; k < size; ++k) {
      const bool of_another = upto(20) == 1;
      text_ << ' ' << (of_another ? index(positions_) : back ? k - size : positions_ - size + k + 1);
      if (has_uvs) text_ << '/' << index(uvs_);
      if (has_normals) text_ << (has_uvs ? "/" : "//") << index(normals_);
    }
    text_ << (upto(5) == 1 ? " " : "") << end_;
  }

  void line() {
    const std::string names[] = {"a", "b", "a b"}, materials[] = {"red", "none", "green"};
    const int kind = upto(12);
    if (kind == 1) text_ << (upto(2) == 1 ? "g " : "o ") << names[upto(3) - 1] << end_;
    if (kind == 2) text_ << "usemtl " << materials[upto(3) - 1] << end_;
    if (kind == 3) text_ << "vt " << real() << ' ' << real() << end_, ++uvs_;
    if (kind == 4) text_ << "vn " << real() << ' ' << real() << ' ' << real() << end_, ++normals_;
    if (kind == 5)
      text_ << "v " << real() << ' ' << real() << ' ' << real() << " 0 .5 1" << end_, ++positions_;
    if (kind == 6) text_ << (upto(2) == 1 ? "" : "# f 1 2 3") << end_;
    if (kind > 6) face();
  }

  std::minstd_rand random_;
  std::string end_;
  std::ostringstream text_;
  int positions_ = 0, uvs_ = 0, normals_ = 0;
  std::vector<std::size_t> non_finite_;
};

constexpr const char* library = "newmtl green\nNs 5\nmap_d leaf.png\nnewmtl red\nNs 30\nKs 1 1 1\n";

// The triangles of a face: as FaceCutter has them, a fan if a corner is not finite.
std::vector<FaceCutter::Triangle> cut(const std::vector<dvec3>& corners) {
  std::vector<FaceCutter::Triangle> triangles;
  if (std::all_of(corners.begin(), corners.end(), [](const dvec3& c) { return finite(vec3(c)); })) {
    FaceCutter().cut(corners, triangles);
    return triangles;
  }
  for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) triangles.push_back({0, k, k + 1});
  return triangles;
}

// The mesh whose faces tinyobjloader reads in one go (a number that is not finite as 0), cut, without the
// triangles of vertices that are not finite; its triangles turned as load_obj turns them.
TriangleMesh by_tinyobjloader(const std::filesystem::path& path, const std::vector<std::size_t>& non_finite) {
  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  const std::string folder = path.parent_path().string() + "/";
  EXPECT_TRUE(
      tinyobj::LoadObj(&attrib, &shapes, &materials, &warnings, &errors, path.c_str(), folder.c_str(), false))
      << errors;
  TriangleMesh mesh;
  const auto triples = [](const std::vector<float>& values) {
    std::vector<vec3> out;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      out.emplace_back(values[i], values[i + 1], values[i + 2]);
    return out;
  };
  mesh.positions = triples(attrib.vertices);
  for (const std::size_t i : non_finite) mesh.positions[i].x = std::numeric_limits<float>::quiet_NaN();
  mesh.normals = triples(attrib.normals);
  for (std::size_t i = 0; i + 1 < attrib.texcoords.size(); i += 2)
    mesh.uvs.emplace_back(attrib.texcoords[i], attrib.texcoords[i + 1]);
  std::map<std::string, std::uint32_t> group_of_name;
  for (const tinyobj::shape_t& shape : shapes) {
    if (shape.mesh.indices.empty()) continue;
    const auto [group, fresh] = group_of_name.try_emplace(shape.name, std::uint32_t(mesh.groups.size()));
    if (fresh) mesh.groups.push_back(shape.name);
    std::size_t first = 0;
    for (std::size_t face = 0; face < shape.mesh.num_face_vertices.size(); ++face) {
      const std::size_t size = shape.mesh.num_face_vertices[face];
      const tinyobj::index_t* corners = &shape.mesh.indices[first];
      first += size;
      if (size < 3) continue;
      std::vector<dvec3> places;
      for (std::size_t k = 0; k < size; ++k)
        places.emplace_back(mesh.positions[std::size_t(corners[k].vertex_index)]);
      for (const FaceCutter::Triangle& triangle : cut(places)) {
        std::array<std::uint32_t, 3> position, normal, uv;
        for (std::size_t k = 0; k < 3; ++k) {
          position[k] = std::uint32_t(corners[triangle[k]].vertex_index);
          normal[k] = std::uint32_t(corners[triangle[k]].normal_index);
          uv[k] = std::uint32_t(corners[triangle[k]].texcoord_index);
        }
        ++mesh.report.triangles_read;
        if (std::any_of(position.begin(), position.end(),
                        [&](auto p) { return !finite(mesh.positions[p]); })) {
          ++mesh.report.non_finite_dropped;
          continue;
        }
        mesh.triangles.push_back(position);
        for (const std::uint32_t p : position) mesh.bounds.add(mesh.positions[p]);
        mesh.triangle_normals.push_back(normal);
        mesh.triangle_uvs.push_back(uv);
        mesh.triangle_group.push_back(group->second);
        mesh.triangle_material.push_back(std::uint32_t(shape.mesh.material_ids[face]));
      }
    }
  }
  for (const tinyobj::material_t& m : materials)
    mesh.materials.push_back({m.name, m.shininess, m.alpha_texname.empty() ? "" : folder + m.alpha_texname});
  end_with_longest_edges(mesh);
  return mesh;
}

void expect_same(const TriangleMesh& mesh, const TriangleMesh& expected) {
  ASSERT_EQ(mesh.positions.size(), expected.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_TRUE(mesh.positions[i] == expected.positions[i] || !finite(expected.positions[i])) << i;
  EXPECT_TRUE(mesh.uvs == expected.uvs);
  ASSERT_EQ(mesh.normals.size(), expected.normals.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    EXPECT_LT(glm::distance(mesh.normals[i], glm::normalize(expected.normals[i])), 1e-6f) << i;
  EXPECT_EQ(mesh.triangles, expected.triangles);
  EXPECT_EQ(mesh.triangle_normals, expected.triangle_normals);
  EXPECT_EQ(mesh.triangle_uvs, expected.triangle_uvs);
  EXPECT_EQ(mesh.triangle_material, expected.triangle_material);
  EXPECT_EQ(mesh.triangle_group, expected.triangle_group);
  EXPECT_EQ(mesh.groups, expected.groups);
  ASSERT_EQ(mesh.materials.size(), expected.materials.size());
  for (std::size_t i = 0; i < mesh.materials.size(); ++i)
    EXPECT_TRUE(mesh.materials[i].name == expected.materials[i].name &&
                mesh.materials[i].phong_exponent == expected.materials[i].phong_exponent &&
                mesh.materials[i].opacity_map == expected.materials[i].opacity_map)
        << i;
  EXPECT_TRUE(mesh.bounds.lo == expected.bounds.lo && mesh.bounds.hi == expected.bounds.hi);
  EXPECT_EQ(mesh.report.triangles_read, expected.report.triangles_read);
  EXPECT_EQ(mesh.report.non_finite_dropped, expected.report.non_finite_dropped);
}

TEST(ObjPieces, AreTheMeshThatTinyobjloaderReads) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.mtl", library);
  unsigned seed = 0;
  for (const char* line_end : {"\n", "\r\n", "\r"})
    for (int i = 0; i < 4; ++i) {
      const RandomObj random(++seed, line_end);
      write_bytes(folder / "mesh.obj", random.text());
      const TriangleMesh expected = by_tinyobjloader(folder / "mesh.obj", random.non_finite());
      ASSERT_GT(expected.report.non_finite_dropped, 5u);
      ASSERT_GT(expected.triangles.size(), 300u);
      ASSERT_GE(expected.groups.size(), 3u);
      for (const std::size_t piece_bytes : {1u, 50u, 1000u, 1u << 21}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", pieces of " << piece_bytes);
        expect_same(load_obj(folder / "mesh.obj", everything, piece_bytes), expected);
      }
    }
}

// What is not wanted is not kept, and is checked all the same.
TEST(ObjPieces, KeepWhatIsWanted) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.mtl", library);
  write_bytes(folder / "mesh.obj", RandomObj(3, "\n").text());
  const TriangleMesh all = load_obj(folder / "mesh.obj", everything);
  const TriangleMesh mesh = load_obj(folder / "mesh.obj", {.normals = false}, 300);
  EXPECT_EQ(mesh.triangles, all.triangles);
  EXPECT_TRUE(mesh.normals.empty() && mesh.triangle_normals.empty() && mesh.uvs.empty() &&
              mesh.triangle_uvs.empty() && mesh.materials.empty() && mesh.groups.empty());
  EXPECT_GT(all.triangle_uvs.size(), 0u);
  write_bytes(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/2 3/1\n");
  test::expect_error(ErrorKind::scene, "mesh.obj:5: face index 2", [&] { load_obj(folder / "mesh.obj"); });
}

TEST(ObjPieces, FaultsHaveTheirLineInTheWholeFile) {
  const TemporaryFolder folder;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n";
  const std::pair<const char*, const char*> faults[] = {
      {"f 1 2 4", "face index 4 is out of range (3 positions)"},
      {"f -1 -2 -4", "face index -4 is out of range (3 positions so far)"},
      {"f 1 2 0", "face index 0 is out of range"},
      {"f 1/1 2/1 3/2", "face index 2 is out of range (1 texture coordinates)"},
      {"f 1//1 2//-2 3//1", "face index -2 is out of range (1 normals so far)"},
      {"f 1/x 2 3", "face index 'x' is not an integer"},
      {"f 1 2 3.5", "face index '3.5' is not an integer"},
      {"f 1 /2 3", "face index '' is not an integer"},
      {"f 1 2 3# 4", "face index '3#' is not an integer"},
      {"f 1 2 - 3", "face index '-' is not an integer"},
      {"f 1 2 3/1/1/1", "a face's corner '3/1/1/1' has more than three indices"},
      {"f 1 2 3///", "a face's corner '3///' has more than three indices"},
      {"f 1 2 12345678901234567890", "face index 12345678901234567890 is out of range"},
      {"f 1 2 +-3", "face index '+-3' is not an integer"},
      {"v 0 zero null", "'zero' is not a number"},
      {"v 0 0 -", "'-' is not a number"},
      {"v 0 0 1,5", "'1,5' is not a number"},
      {"v 0 0 1.5.", "'1.5.' is not a number"},
      {"v 0 0 --7", "'--7' is not a number"},
      {"v 0 0 \xe2\x88\x92 1", "'\xe2\x88\x92' is not a number"},
      {"vn 0 1", "2 numbers, expected 3"},
  };
  for (const auto& [line, message] : faults)
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
      const std::string text = std::regex_replace(square + line + "\nf x y z\n", std::regex("\n"), line_end);
      write_bytes(folder / "mesh.obj", text);
      for (const std::size_t piece_bytes : {1u, 1u << 21})
        test::expect_error(ErrorKind::scene, std::string("mesh.obj:7: ") + message,
                           [&] { load_obj(folder / "mesh.obj", everything, piece_bytes); });
    }
}

TEST(ObjPieces, NumbersAsTheyMayBeWritten) {
  const TemporaryFolder folder;
  write_bytes(folder / "mesh.obj",
              "v +1. -.5e+1 1E-1 1 1 1\nv 00.50 -0 1e0 # one\nv 0 1 0\nf 01 0000000000002 +3\n");
  const TriangleMesh mesh = load_obj(folder / "mesh.obj");
  EXPECT_EQ(mesh.positions[0], vec3(1, -5, .1f));
  EXPECT_EQ(mesh.positions[1], vec3(.5f, 0, 1));
}

// What a search for the next line takes must not depend on how far the next one of another kind is.
TEST(ObjPieces, LinesOfAnOldMacAreReadInOnePass) {
  const TemporaryFolder folder;
  std::string text = "v 0 0 0\rv 1 0 0\rv 0 1 0\r";
  for (int i = 0; i < 400000; ++i) text += "f 1 2 3\r";
  write_bytes(folder / "mesh.obj", text);
  EXPECT_EQ(load_obj(folder / "mesh.obj").triangles.size(), 400000u);
}

TEST(ObjPieces, FacesMayReferForwardAndEndInComments) {
  const TemporaryFolder folder;
  write_bytes(folder / "mesh.obj",
              "f 1 2 +3 # 7 corners, 1/2\nf 1 2 3 4 #\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n");
  for (const std::size_t piece_bytes : {1u, 1u << 21})
    EXPECT_EQ(load_obj(folder / "mesh.obj", everything, piece_bytes).triangles.size(), 3u);
}

}  // namespace
}  // namespace nook
