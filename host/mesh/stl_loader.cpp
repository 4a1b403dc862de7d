#include "mesh/stl_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "base/error.hpp"
#include "mesh/mesh_text.hpp"
#include "mesh/obj_text.hpp"
#include "mesh/triangulate.hpp"
#include "mesh/vertex_welder.hpp"
#include "mesh/words.hpp"

namespace nook {
namespace {

// A header of 80 bytes, a count; then for each triangle its normal and corners as floats, and two bytes more.
constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

template <class T>
T little_endian(const char* from) {
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof(T));
  std::uint32_t value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) value = value << 8 | bytes[i];
  T number;
  std::memcpy(&number, &value, sizeof(T));
  return number;
}

std::size_t binary_size(std::string_view bytes) {
  return bytes.size() < header_bytes
             ? 0
             : header_bytes + triangle_bytes * std::size_t(little_endian<std::uint32_t>(bytes.data() + 80));
}

void read_binary(std::string_view bytes, PolygonMesh& mesh) {
  const std::size_t expected = binary_size(bytes);
  if (bytes.size() < std::max(expected, header_bytes))
    throw Error(ErrorKind::scene, Place{mesh.name},
                expected == 0
                    ? "neither an ASCII STL file nor as long as a binary one's header"
                    : fmt::format("the file ends too early: {} bytes, its {} triangles take {}", bytes.size(),
                                  (expected - header_bytes) / triangle_bytes, expected));
  if (bytes.size() > expected)
    mesh.warnings.push_back(fmt::format("{}: {} bytes behind the last triangle are left out", mesh.name,
                                        bytes.size() - expected));
  FaceBlock& block = mesh.blocks[0];
  const std::size_t count = (expected - header_bytes) / triangle_bytes;
  block.positions.reserve(3 * count);
  block.face_sizes.assign(count, 3);
  VertexWelder vertices(mesh.positions);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const char* corner = bytes.data() + header_bytes + triangle_bytes * t + 12 * (k + 1);
      block.positions.push_back(vertices.index_of(dvec3(
          little_endian<float>(corner), little_endian<float>(corner + 4), little_endian<float>(corner + 8))));
    }
  if (count > 0) block.runs.push_back({});
}

class AsciiReader {
 public:
  AsciiReader(PolygonMesh& mesh, const std::string& unnamed)
      : mesh_(mesh), block_(mesh.blocks[0]), unnamed_(unnamed), vertices_(mesh.positions) {}

  void read(std::string_view statement, std::size_t line) {
    line_ = line;
    for (std::string word = lower(next_word(statement)); !word.empty(); word = lower(next_word(statement))) {
      if (word == "solid" || word == "endsolid") {
        in_solid_ = word == "solid";
        const std::string_view name = take_name(statement);
        if (in_solid_) solid(name);
      } else if (word == "vertex") {
        vertex(statement);
      } else if (word == "endloop") {
        end_loop();
      } else if (word == "normal") {
        for (int axis = 0; axis < 3; ++axis) next_word(statement);
      } else if (word == "outer" || word == "loop" || word == "facet" || word == "endfacet") {
        if (corners_ != 0) fail("a facet begins or ends within a loop");
      } else {
        fail(fmt::format("unknown word '{}'", word.substr(0, 40)));
      }
    }
  }

  void end() {
    if (corners_ != 0) fail("the file ends within a facet");
    if (in_solid_)
      mesh_.warnings.push_back(fmt::format("{}:{}: the file ends without endsolid", mesh_.name, line_));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::scene, Place{mesh_.name, line_}, what);
  }

  // What stands before the first facet: a whole file may be one line.
  static std::string_view take_name(std::string_view& statement) {
    const std::string_view whole = statement;
    for (std::string_view rest = statement;; statement = rest)
      if (const std::string_view word = next_word(rest); word.empty() || lower(word) == "facet") break;
    return trimmed(whole.substr(0, whole.size() - statement.size()));
  }

  void solid(std::string_view name) {
    const std::string group = name.empty() ? unnamed_ : std::string(name);
    const auto found = std::find(mesh_.groups.begin(), mesh_.groups.end(), group);
    group_ = std::uint32_t(found - mesh_.groups.begin());
    if (found == mesh_.groups.end()) mesh_.groups.push_back(group);
  }

  void vertex(std::string_view& text) {
    dvec3 place(0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = next_word(text);
      if (word.empty()) fail(fmt::format("{} numbers, expected 3", axis));
      if (!read_number(word, place[axis])) fail(fmt::format("'{}' is not a number", word.substr(0, 40)));
    }
    block_.positions.push_back(vertices_.index_of(place));
    ++corners_;
  }

  void end_loop() {
    if (corners_ < 3) fail(fmt::format("a facet of {} corners", corners_));
    if (block_.runs.empty() || block_.runs.back().group != group_)
      block_.runs.push_back({block_.face_sizes.size(), group_});
    block_.face_sizes.push_back(corners_);
    if (corners_ > 3) block_.places.push_back(std::uint32_t(line_));
    corners_ = 0;
  }

  PolygonMesh& mesh_;
  FaceBlock& block_;
  const std::string& unnamed_;
  VertexWelder vertices_;
  std::size_t line_ = 0;
  std::uint32_t corners_ = 0, group_ = 0;
  bool in_solid_ = false;
};

// The header of a binary file may begin with "solid" as well; but a count and small numbers hold zeros.
bool is_ascii(std::string_view text) {
  const std::string head = lower(text.substr(0, 1024));
  return head.find('\0') == std::string::npos &&
         (head.find("solid") != std::string::npos || head.find("facet") != std::string::npos);
}

}  // namespace

TriangleMesh load_stl(const std::filesystem::path& path, const MeshAttributes& attributes) {
  MeshAttributes want = attributes;
  want.materials = want.uvs = want.normals = false;
  PolygonMesh mesh;
  mesh.name = path.string();
  mesh.blocks.resize(1);
  const std::string unnamed = path.stem().string();
  {
    const LargeVector<char> bytes = read_mesh_file(path);
    const std::string_view all(bytes.data(), bytes.size()), text = without_byte_order_mark(all, path);
    if (all.size() != binary_size(all) && is_ascii(text)) {
      AsciiReader reader(mesh, unnamed);
      for_each_statement(text, [&](std::string_view statement, std::size_t line) {
        reader.read(statement, line);
        return true;
      });
      reader.end();
    } else {
      read_binary(all, mesh);
    }
  }
  if (mesh.groups.empty()) mesh.groups = {unnamed};
  return triangulated(std::move(mesh), want);
}

}  // namespace nook
