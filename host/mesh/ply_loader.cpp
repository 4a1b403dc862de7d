#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/mesh_text.hpp"
#include "mesh/ply.hpp"
#include "mesh/ply_body.hpp"
#include "mesh/triangulate.hpp"

namespace nook {
namespace {

class PlyLoader {
 public:
  PlyLoader(PlyBody& body, const PlyHeader& header, const MeshAttributes& want, PolygonMesh& mesh)
      : body_(body), want_(want), mesh_(mesh) {
    for (const PlyElement& element : header.elements)
      if (element.name == "vertex") vertices_ += element.count;
    mesh_.blocks.resize(1);
    mesh_.place = body.is_text() ? "" : " face ";
    for (const PlyElement& element : header.elements)
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        skip(element);
    join_uvs();
  }

 private:
  FaceBlock& block() { return mesh_.blocks.back(); }

  // The corners of a block: few enough to keep all threads busy that cut faces.
  void begin_face() {
    constexpr std::size_t enough = 1 << 17;
    if (block().positions.size() >= enough) mesh_.blocks.emplace_back();
  }

  void read_vertices(const PlyElement& element) {
    static constexpr std::array<const char*, 2> uv_names[] = {
        {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    const auto place = [&](const char* name) { return element.find(name, false); };
    const std::array<int, 3> at = {place("x"), place("y"), place("z")},
                             normal_at = {place("nx"), place("ny"), place("nz")};
    std::array<int, 2> uv_at = {-1, -1};
    for (const auto& [u, v] : uv_names)
      if (uv_at[0] < 0 && place(u) >= 0 && place(v) >= 0) uv_at = {place(u), place(v)};
    if (std::count(at.begin(), at.end(), -1)) body_.fail("vertices need the properties x, y and z");
    // No count is believed that the file cannot hold.
    if (element.count > body_.most_values_left())
      body_.fail(fmt::format("{} vertices are more than the file holds", element.count));
    const bool with_normals = want_.normals && !std::count(normal_at.begin(), normal_at.end(), -1);
    const bool with_uvs = want_.uvs && uv_at[0] >= 0;
    mesh_.positions.reserve(vertices_);
    std::vector<double> row(element.properties.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < row.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (!property.is_list)
          row[p] = body_.value(property.type);
        else
          skip(property);
      }
      const auto number = [&](int p) { return row[std::size_t(p)]; };
      mesh_.positions.emplace_back(number(at[0]), number(at[1]), number(at[2]));
      if (with_normals)
        mesh_.normals.emplace_back(number(normal_at[0]), number(normal_at[1]), number(normal_at[2]));
      if (with_uvs) mesh_.uvs.emplace_back(number(uv_at[0]), number(uv_at[1]));
    }
    mesh_.vertices_have_normals = with_normals && mesh_.normals.size() == mesh_.positions.size();
    mesh_.vertices_have_uvs = with_uvs && mesh_.uvs.size() == mesh_.positions.size();
  }

  std::uint32_t checked_index(double value) {
    if (!(value >= 0 && value < double(vertices_)))
      body_.fail(fmt::format("vertex index {} is out of range ({} vertices)", value, vertices_));
    const std::uint32_t whole = std::uint32_t(value);
    if (double(whole) != value) body_.fail(fmt::format("vertex index {} is not an integer", value));
    return whole;
  }

  static bool are_indices(const PlyProperty& p) {
    return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
  }

  void read_faces(const PlyElement& element) {
    if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), are_indices))
      body_.fail("faces need the list vertex_indices");
    const bool with_uvs = want_.uvs && element.find("texcoord", true) >= 0;
    std::vector<double> uvs;
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      begin_face();
      const std::size_t first = block().positions.size();
      body_.skip_blanks();
      const std::size_t place = body_.is_text() ? body_.line() : std::size_t(i + 1);
      uvs.clear();
      for (const PlyProperty& property : element.properties) {
        if (are_indices(property)) {
          for (std::size_t k = body_.list_size(property.count_type); k > 0; --k)
            block().positions.push_back(checked_index(body_.value(property.type)));
        } else if (with_uvs && property.is_list && property.name == "texcoord") {
          for (std::size_t k = body_.list_size(property.count_type); k > 0; --k)
            uvs.push_back(body_.value(property.type));
        } else {
          skip(property);
        }
      }
      add_face(first, place, uvs);
    }
  }

  // The face of the corners from `first` on; `uvs` are two numbers a corner, or none.
  void add_face(std::size_t first, std::size_t place, const std::vector<double>& uvs) {
    FaceBlock& faces = block();
    const std::size_t size = faces.positions.size() - first;
    if (size < 3) {
      faces.positions.resize(first);
      return;
    }
    if (uvs.size() == 2 * size) {
      faces.uvs.resize(first, FaceBlock::none);
      for (std::size_t k = 0; k < size; ++k) {
        faces.uvs.push_back(std::uint32_t(corner_uvs_.size()));
        corner_uvs_.emplace_back(uvs[2 * k], uvs[2 * k + 1]);
      }
    }
    faces.face_sizes.push_back(std::uint32_t(size));
    if (size > 3) faces.places.push_back(std::uint32_t(place));
  }

  // Triangles of three corners that follow one another, every other one turned over. -1, also as 32 bits
  // without a sign, begins a new strip.
  void read_strips(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
      for (const PlyProperty& property : element.properties) {
        if (!are_indices(property)) {
          skip(property);
          continue;
        }
        std::vector<std::uint32_t> strip;
        for (std::size_t k = body_.list_size(property.count_type); k > 0; --k) {
          const double value = body_.value(property.type);
          if (value == -1 || (value == 0xffffffffu && property.type == PlyType::u32)) {
            add_strip(strip);
            strip.clear();
          } else {
            strip.push_back(checked_index(value));
          }
        }
        add_strip(strip);
      }
  }

  void add_strip(const std::vector<std::uint32_t>& strip) {
    for (std::size_t k = 2; k < strip.size(); ++k) {
      const std::uint32_t a = strip[k - 2], b = strip[k - 1], c = strip[k];
      if (a == b || b == c || c == a) continue;  // joins two strips
      const bool turned = k % 2;
      block().positions.insert(block().positions.end(), {turned ? b : a, turned ? a : b, c});
      block().face_sizes.push_back(3);
    }
  }

  void skip(const PlyProperty& property) {
    std::size_t count = property.is_list ? body_.list_size(property.count_type) : 1;
    for (; count > 0; --count) body_.value(property.type);
  }

  void skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
      for (const PlyProperty& property : element.properties) skip(property);
  }

  // Corners' own texture coordinates stand behind those of vertices; corners without have their vertices'.
  void join_uvs() {
    if (corner_uvs_.empty()) return;
    for (FaceBlock& faces : mesh_.blocks) {
      faces.uvs.resize(faces.positions.size(), FaceBlock::none);
      for (std::size_t c = 0; c < faces.uvs.size(); ++c)
        if (faces.uvs[c] != FaceBlock::none)
          faces.uvs[c] += std::uint32_t(mesh_.uvs.size());
        else if (mesh_.vertices_have_uvs)
          faces.uvs[c] = faces.positions[c];
    }
    mesh_.uvs.insert(mesh_.uvs.end(), corner_uvs_.begin(), corner_uvs_.end());
    mesh_.vertices_have_uvs = false;
  }

  PlyBody& body_;
  const MeshAttributes& want_;
  PolygonMesh& mesh_;
  std::uint64_t vertices_ = 0;
  std::vector<vec2> corner_uvs_;
};

}  // namespace

TriangleMesh load_ply(const std::filesystem::path& path, const MeshAttributes& attributes) {
  MeshAttributes want = attributes;
  want.materials = false;
  PolygonMesh mesh;
  mesh.name = path.string();
  {
    const LargeVector<char> bytes = read_mesh_file(path);
    const std::string_view text = without_byte_order_mark({bytes.data(), bytes.size()}, path);
    const PlyHeader header = read_ply_header(text, mesh.name);
    PlyBody body(text, header, mesh.name);
    PlyLoader(body, header, want, mesh);
  }
  if (want.groups) mesh.groups = {path.stem().string()};
  for (FaceBlock& block : mesh.blocks) block.runs.push_back({});
  return triangulated(std::move(mesh), want);
}

}  // namespace nook
