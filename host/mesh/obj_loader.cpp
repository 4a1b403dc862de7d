#include "mesh/obj_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/task_pool.hpp"
#include "base/threads.hpp"
#include "mesh/mesh_text.hpp"
#include "mesh/obj_materials.hpp"
#include "mesh/obj_piece.hpp"
#include "mesh/triangulate.hpp"

namespace nook {
namespace {

using Change = ObjPiece::Change;

// Counts all pieces, says what stands before each, and returns what the whole text holds.
ObjCounts count_pieces(TaskPool& pool, std::vector<ObjPiece>& pieces) {
  pool.for_ranges(pieces.size(), 1,
                  [&](std::size_t i, std::size_t) { pieces[i].counts = count_obj(pieces[i].text); });
  ObjCounts all;
  for (ObjPiece& piece : pieces) {
    piece.before = all;
    all.lines += piece.counts.lines;
    all.positions += piece.counts.positions;
    all.uvs += piece.counts.uvs;
    all.normals += piece.counts.normals;
  }
  return all;
}

ObjMaterials load_materials(const std::filesystem::path& path, const std::vector<ObjPiece>& pieces,
                            const MeshAttributes& want) {
  std::vector<ObjLibrary> libraries;
  for (const ObjPiece& piece : pieces)
    for (const Change& change : piece.changes)
      if (change.kind == Change::Kind::library) libraries.push_back({change.text, change.line});
  return load_obj_materials(path, libraries, want);
}

// The groups of a file by their names. One may be continued: its name is what makes it one; it counts from
// its first face on.
class Groups {
 public:
  explicit Groups(PolygonMesh& mesh) : mesh_(mesh) {}

  void change_to(const Change& change) {
    names_.clear();
    name_ = change.kind == Change::Kind::object ? change.text : "";
    if (change.kind == Change::Kind::object) return;
    std::string_view words = change.text;
    for (std::string_view word = next_word(words); !word.empty(); word = next_word(words))
      names_.emplace_back(word);
    name_ = fmt::format("{}", fmt::join(names_, " "));
    if (names_.size() == 1) names_.clear();
  }

  std::uint32_t current() {
    const auto [place, fresh] = index_of_.try_emplace(name_, std::uint32_t(mesh_.groups.size()));
    if (fresh) mesh_.groups.push_back(name_);
    if (!names_.empty()) {
      mesh_.group_names.resize(mesh_.groups.size());
      mesh_.group_names[place->second] = names_;
    }
    return place->second;
  }

 private:
  PolygonMesh& mesh_;
  std::map<std::string, std::uint32_t> index_of_;
  std::string name_;
  std::vector<std::string> names_;  // of several
};

// What the pieces' faces belong to, from the changes in all of them. A material's library may stand anywhere
// in the file.
void add_runs(std::vector<ObjPiece>& pieces, ObjMaterials& materials, PolygonMesh& mesh) {
  Groups groups(mesh);
  std::uint32_t material = TriangleMesh::no_material;
  for (ObjPiece& piece : pieces) {
    std::size_t begin = 0;
    const auto run_to = [&](std::size_t end) {
      if (end == begin) return;
      piece.block.runs.push_back({begin, groups.current(), material});
      begin = end;
    };
    for (const Change& change : piece.changes) {
      if (change.kind == Change::Kind::library) continue;
      run_to(change.face);
      if (change.kind != Change::Kind::material)
        groups.change_to(change);
      else if (!change.text.empty())
        material = materials.find(change.text, change.line);
    }
    run_to(piece.block.face_sizes.size());
  }
  if (!mesh.group_names.empty()) mesh.group_names.resize(mesh.groups.size());
}

void warn_of_odd_uvs(const std::vector<ObjPiece>& pieces, PolygonMesh& mesh) {
  std::size_t line = 0, count = 0;
  for (const ObjPiece& piece : pieces) {
    if (count == 0) line = piece.odd_uv_line;
    count += piece.odd_uvs;
  }
  if (count == 0) return;
  const std::string others = count > 1 ? fmt::format(" (and {} more)", count - 1) : "";
  mesh.warnings.push_back(
      fmt::format("{}:{}: texture coordinates that are no finite numbers{}: corners with them have none",
                  mesh.name, line, others));
}

}  // namespace

TriangleMesh load_obj(const std::filesystem::path& path, const MeshAttributes& want,
                      std::size_t piece_bytes) {
  PolygonMesh mesh;
  mesh.name = path.string();
  LargeVector<char> bytes = read_mesh_file(path);
  const std::string_view text = without_byte_order_mark({bytes.data(), bytes.size()}, path);
  std::vector<ObjPiece> pieces;
  for (const std::string_view piece : obj_pieces(text, piece_bytes)) pieces.emplace_back().text = piece;
  TaskPool pool(unsigned(std::min<std::size_t>(threads_to_use(), std::max<std::size_t>(pieces.size(), 1))));

  const ObjCounts all = count_pieces(pool, pieces);
  mesh.positions.resize(all.positions);
  mesh.normals.resize(want.normals ? all.normals : 0);
  mesh.uvs.resize(want.uvs ? all.uvs : 0);
  pool.for_ranges(pieces.size(), 1,
                  [&](std::size_t i, std::size_t) { read_obj_piece(pieces[i], all, want, mesh); });
  for (const ObjPiece& piece : pieces)
    if (!piece.fault.empty()) throw Error(ErrorKind::scene, Place{mesh.name, piece.fault_line}, piece.fault);
  LargeVector<char>().swap(bytes);

  ObjMaterials materials;
  if (want.materials) materials = load_materials(path, pieces, want);
  add_runs(pieces, materials, mesh);
  if (want.materials) {
    for (std::string& warning : materials.warnings()) mesh.warnings.push_back(std::move(warning));
    mesh.materials = std::move(materials.materials);
  }
  warn_of_odd_uvs(pieces, mesh);
  for (ObjPiece& piece : pieces) mesh.blocks.push_back(std::move(piece.block));
  return triangulated(std::move(mesh), want);
}

}  // namespace nook
