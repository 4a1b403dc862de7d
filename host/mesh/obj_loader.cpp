#include "mesh/obj_loader.hpp"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <istream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "mesh/corner_order.hpp"
#include "mesh/mtl_scan.hpp"
#include "mesh/obj_scan.hpp"

namespace nook {
namespace {

// A stream over memory, without copying it.
struct MemoryBuffer : std::streambuf {
  explicit MemoryBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

// Reads MTL files beside the OBJ; a name that is no regular file (a folder, a FIFO, a device) is left unread.
class MaterialFiles : public tinyobj::MaterialReader {
 public:
  explicit MaterialFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool operator()(const std::string& id, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* map, std::string* warn, std::string* err) override {
    std::error_code code;
    if (!std::filesystem::is_regular_file(folder_ / id, code)) return false;
    std::ifstream in(folder_ / id, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    with_lobe_.merge(materials_with_lobe(text, (folder_ / id).string()));
    std::istringstream again(text);
    const std::size_t known = materials->size();
    tinyobj::LoadMtl(map, materials, &again, warn, err);
    for (std::size_t m = known; m < materials->size(); ++m) {
      std::string& texture = (*materials)[m].alpha_texname;
      std::replace(texture.begin(), texture.end(), '\\', '/');
      if (!texture.empty()) texture = ((folder_ / id).parent_path() / texture).string();
    }
    return true;
  }
  bool has_lobe(const std::string& material) const { return with_lobe_.contains(material); }

 private:
  std::filesystem::path folder_;
  std::set<std::string> with_lobe_;
};

// A material library may have blanks in its name; tinyobjloader takes what they part for several libraries,
// unless they are escaped. They are, where the whole is a file.
void escape_library_names(std::string& text, const std::filesystem::path& folder) {
  const std::string_view key = "mtllib ";
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    const std::size_t first = text.find_first_not_of(" \t", at + key.size());
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    if (first >= end) continue;
    const std::size_t last = text.find_last_not_of(" \t", end - 1);
    std::string name = text.substr(first, last + 1 - first);
    std::error_code code;
    if (name.find(' ') == std::string::npos || !std::filesystem::is_regular_file(folder / name, code))
      continue;
    for (std::size_t blank = name.find(' '); blank != std::string::npos; blank = name.find(' ', blank + 2))
      name.insert(blank, 1, '\\');
    text.replace(first, last + 1 - first, name);
  }
}

std::string read_text(const std::filesystem::path& path) {
  std::string text(size_of_input(path), '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in || !in.read(text.data(), std::streamsize(text.size())))
    throw Error(ExitCode::scene, fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
  return text;
}

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<vec3> triples(const std::vector<tinyobj::real_t>& values) {
  std::vector<vec3> out(values.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

// Unit normals; those that cannot be normalised become 0 and are skipped by corner_normal below.
void normalise(TriangleMesh& mesh) {
  for (vec3& n : mesh.normals) {
    const double length = glm::length(dvec3(n));
    const bool usable = std::isfinite(length) && length > 1e-30;
    if (usable && std::abs(length - 1) > 1e-3) ++mesh.report.normals_normalised;
    n = usable ? vec3(dvec3(n) / length) : vec3(0);
  }
}

std::uint32_t corner_normal(const TriangleMesh& mesh, int index) {
  const bool usable = index >= 0 && mesh.normals[std::size_t(index)] != vec3(0);
  return usable ? std::uint32_t(index) : TriangleMesh::no_normal;
}

void append_shape(const tinyobj::shape_t& shape, std::uint32_t group, const MeshAttributes& want,
                  TriangleMesh& mesh) {
  const auto& indices = shape.mesh.indices;
  for (std::size_t first = 0; first + 2 < indices.size(); first += 3) {
    ++mesh.report.triangles_read;
    std::array<std::uint32_t, 3> position{}, normal{}, uv{};
    bool kept = true;
    for (int k = 0; k < 3; ++k) {
      const tinyobj::index_t& corner = indices[first + std::size_t(k)];
      position[std::size_t(k)] = std::uint32_t(corner.vertex_index);
      normal[std::size_t(k)] = want.normals ? corner_normal(mesh, corner.normal_index) : 0;
      uv[std::size_t(k)] = std::uint32_t(corner.texcoord_index);
      kept = kept && finite(mesh.positions[position[std::size_t(k)]]);
    }
    if (!kept) {
      ++mesh.report.non_finite_dropped;
      continue;
    }
    mesh.triangles.push_back(position);
    if (want.normals) mesh.triangle_normals.push_back(normal);
    if (want.uvs) mesh.triangle_uvs.push_back(uv);
    if (want.materials) mesh.triangle_material.push_back(std::uint32_t(shape.mesh.material_ids[first / 3]));
    if (want.groups) mesh.triangle_group.push_back(group);
    for (std::uint32_t index : position) mesh.bounds.add(mesh.positions[index]);
  }
}

// Every index in range, for positions as for what is optional: tinyobjloader only warns, or drops the face.
bool indices_valid(const tinyobj::attrib_t& attrib, const std::vector<tinyobj::shape_t>& shapes,
                   const std::string& warnings) {
  if (warnings.find("out of bounds") != std::string::npos ||
      warnings.find("invalid vertex index") != std::string::npos)
    return false;
  const auto positions = int(attrib.vertices.size() / 3), normals = int(attrib.normals.size() / 3),
             uvs = int(attrib.texcoords.size() / 2);
  for (const auto& shape : shapes)
    for (const auto& i : shape.mesh.indices)
      if (i.vertex_index < 0 || i.vertex_index >= positions || i.normal_index >= normals ||
          i.texcoord_index >= uvs)
        return false;
  return true;
}

}  // namespace

TriangleMesh load_obj(const std::filesystem::path& path, const MeshAttributes& want) {
  const std::string name = path.string();
  std::string text = read_text(path);
  const ObjScan scan = scan_obj(text, name);
  if (want.materials) escape_library_names(text, path.parent_path());

  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  MaterialFiles material_files(path.parent_path());
  MemoryBuffer buffer(text);
  std::istream in(&buffer);
  const bool parsed = tinyobj::LoadObj(&attrib, &shapes, &materials, &warnings, &errors, &in,
                                       want.materials ? &material_files : nullptr, /*triangulate=*/true,
                                       /*default_vcols_fallback=*/false);
  if (!parsed || !indices_valid(attrib, shapes, warnings)) {
    std::string place = find_bad_face(text, name);
    if (place.empty())
      place = fmt::format("{}: {}", name,
                          errors.empty() ? "a face cannot be read" : errors.substr(0, errors.find('\n')));
    throw Error(ExitCode::scene, place);
  }
  std::string().swap(text);

  TriangleMesh mesh;
  mesh.positions = triples(attrib.vertices);
  for (std::uint32_t i : scan.non_finite_positions)
    if (i < mesh.positions.size()) mesh.positions[i].x = std::numeric_limits<float>::quiet_NaN();
  if (want.normals) {
    mesh.normals = triples(attrib.normals);
    for (std::uint32_t i : scan.non_finite_normals)
      if (i < mesh.normals.size()) mesh.normals[i].x = std::numeric_limits<float>::quiet_NaN();
    normalise(mesh);
  }
  if (want.uvs)
    for (std::size_t i = 0; i + 1 < attrib.texcoords.size(); i += 2)
      mesh.uvs.emplace_back(attrib.texcoords[i], attrib.texcoords[i + 1]);
  std::map<std::string, std::uint32_t> group_of_name;
  for (const tinyobj::shape_t& shape : shapes) {
    // A group may be continued: its name is what makes it one.
    const auto [group, fresh] = group_of_name.try_emplace(shape.name, std::uint32_t(group_of_name.size()));
    if (want.groups && fresh) mesh.groups.push_back(shape.name);
    append_shape(shape, group->second, want, mesh);
  }
  for (const auto& corners : mesh.triangle_normals)
    for (std::uint32_t n : corners) mesh.report.normals_replaced += n == TriangleMesh::no_normal;
  if (mesh.report.normals_replaced == 3 * mesh.triangles.size()) {
    mesh.normals.clear();
    mesh.triangle_normals.clear();
    mesh.report.normals_replaced = 0;
  }
  const auto no_uv = [](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(), [](std::uint32_t i) { return i == 0xffffffffu; });
  };
  if (std::all_of(mesh.triangle_uvs.begin(), mesh.triangle_uvs.end(), no_uv)) mesh.triangle_uvs.clear();
  for (const tinyobj::material_t& m : materials)
    mesh.materials.push_back(
        {m.name, material_files.has_lobe(m.name) ? m.shininess : -1.0f, m.alpha_texname});
  if (mesh.triangles.empty())
    throw Error(ExitCode::scene,
                mesh.report.non_finite_dropped
                    ? fmt::format("{}: no triangle is left ({} have NaN or infinite vertices)", name,
                                  mesh.report.non_finite_dropped)
                    : fmt::format("{}: the mesh has no triangles", name));
  end_with_longest_edges(mesh);
  return mesh;
}

}  // namespace nook
