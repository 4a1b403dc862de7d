#include "readers.hpp"

#include <xxhash.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "app/commands/delivery.hpp"
#include "base/error.hpp"
#include "film/film_part_file.hpp"
#include "image/exr.hpp"
#include "mesh/load_mesh.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/obj_loader.hpp"
#include "mesh/ply.hpp"
#include "picture/picture.hpp"
#include "points/points.hpp"
#include "report/study_file.hpp"
#include "scene/scene_toml.hpp"
#include "support/temporary_folder.hpp"

namespace nook::fuzz {
namespace {

constexpr MeshAttributes everything = {
    .normals = true, .uvs = true, .materials = true, .groups = true, .exponents = true};

// What the device would read without asking.
void use(const TriangleMesh& mesh) {
  analyse(mesh);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t index : triangle)
      if (index >= mesh.positions.size()) throw std::logic_error("a position index out of range got through");
  for (const auto& triangle : mesh.triangle_normals)
    for (const std::uint32_t index : triangle)
      if (index != TriangleMesh::no_normal && index >= mesh.normals.size())
        throw std::logic_error("a normal index out of range got through");
  for (const auto& triangle : mesh.triangle_uvs)
    for (const std::uint32_t index : triangle)
      if (index != TriangleMesh::no_uv && index >= mesh.uvs.size())
        throw std::logic_error("a uv index out of range got through");
  for (const std::string& warning : mesh.report.warnings)
    if (warning.empty() || warning.find('\n') != std::string::npos || warning.size() > 2000)
      throw std::logic_error("not one line of warning: " + warning.substr(0, 200));
}

// The mesh, or what is wrong with it.
struct Outcome {
  TriangleMesh mesh;
  std::string fault;
};

Outcome outcome_of_obj(const std::string& path, std::size_t piece_bytes) {
  try {
    return {load_obj(path, everything, piece_bytes), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

// What mesh_hash() leaves out too.
bool same(const Outcome& a, const Outcome& b) {
  const auto bytes = [](const std::vector<vec2>& v) {
    return std::string_view(reinterpret_cast<const char*>(v.data()), v.size() * sizeof v[0]);
  };
  const TriangleMesh::Report &x = a.mesh.report, &y = b.mesh.report;
  return a.fault == b.fault && mesh_hash(a.mesh) == mesh_hash(b.mesh) &&
         a.mesh.triangle_uvs == b.mesh.triangle_uvs && bytes(a.mesh.uvs) == bytes(b.mesh.uvs) &&
         a.mesh.bounds.lo == b.mesh.bounds.lo && a.mesh.bounds.hi == b.mesh.bounds.hi &&
         x.triangles_read == y.triangles_read && x.non_finite_dropped == y.non_finite_dropped &&
         x.normals_replaced == y.normals_replaced && x.normals_normalised == y.normals_normalised &&
         x.warnings == y.warnings && a.mesh.group_names == b.mesh.group_names;
}

// Where a part has its checksums, see docs/checkpoints.md.
void mend_checksums(std::string& part) {
  constexpr std::size_t header = 24;
  std::uint32_t length = 0;
  if (part.size() < header + 8) return;
  std::memcpy(&length, part.data() + 12, sizeof length);
  if (length > part.size() - header - 8) return;
  const std::uint64_t first = XXH3_64bits(part.data() + header, length),
                      second = XXH3_64bits(part.data() + header + length, part.size() - header - length - 8);
  std::memcpy(part.data() + 16, &first, sizeof first);
  std::memcpy(part.data() + part.size() - 8, &second, sizeof second);
}

void use_part(const std::string& path) {
  FilmPart part = read_film_part(path);
  make_picture(part);
  FilmPart again = part;
  join_film_part(again, "a", part, "b");
}

}  // namespace

void read_scene(const std::string& path) {
  validate(load_scene(path));
}

void read_obj_mesh(const std::string& path) {
  const std::filesystem::path library = std::filesystem::path(path).parent_path() / "a.mtl";
  if (!std::filesystem::exists(library))
    test::write_bytes(library, "newmtl m\nNs 3\nnewmtl n\nmap_d n.png\n");
  const Outcome whole = outcome_of_obj(path, 1 << 21), pieces = outcome_of_obj(path, 40);
  if (!same(whole, pieces)) throw std::logic_error("its pieces change what is read: " + pieces.fault);
  if (!whole.fault.empty()) throw Error(ErrorKind::scene, whole.fault);
  use(whole.mesh);
}

void read_ply_mesh(const std::string& path) {
  use(load_ply(path, everything));
}

void read_stl_mesh(const std::string& path) {
  use(load_mesh(path, everything));
}

void read_compressed_mesh(const std::string& path) {
  use(load_mesh(path, everything));
}

void read_materials(const std::string& path) {
  const std::filesystem::path mesh = std::filesystem::path(path).parent_path() / "mesh.obj";
  test::write_bytes(mesh, "mtllib input.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  read_obj_mesh(mesh);
}

void read_points(const std::string& path) {
  load_points(path, true);
}

void read_part(const std::string& path) {
  std::string bytes = test::read_bytes(path);
  try {
    use_part(path);
  } catch (const Error&) {
    mend_checksums(bytes);
    test::write_bytes(path, bytes);
    use_part(path);
  }
}

void read_image(const std::string& path) {
  read_exr(path);
}

void read_study(const std::string& path) {
  read_study_points(path, {{"scene", "a.toml"}}, {"scene"});
}

void read_delivery_config(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  test::write_bytes(folder / "a.toml", "[input]\nobjfile = \"a.obj\"\n");
  read_delivery(path, "", {folder});
}

}  // namespace nook::fuzz
