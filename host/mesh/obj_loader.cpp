#include "mesh/obj_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/large_vector.hpp"
#include "base/task_pool.hpp"
#include "base/threads.hpp"
#include "mesh/obj_materials.hpp"
#include "mesh/obj_piece.hpp"
#include "mesh/obj_triangles.hpp"

namespace nook {
namespace {

LargeVector<char> read_text(const std::filesystem::path& path) {
  LargeVector<char> text(size_of_input(path));
  std::ifstream in(path, std::ios::binary);
  if (!in || !in.read(text.data(), std::streamsize(text.size())))
    throw Error(ExitCode::scene, fmt::format("{}: cannot be read ({})", path.string(), std::strerror(errno)));
  return text;
}

// Unit normals of places [begin, end); those that cannot be normalised become 0, which corners do not refer
// to. Returns how many had another length.
std::uint64_t normalise(std::vector<vec3>& normals, std::size_t begin, std::size_t end) {
  std::uint64_t changed = 0;
  for (std::size_t i = begin; i < end; ++i) {
    vec3& n = normals[i];
    const double length = glm::length(dvec3(n));
    const bool usable = std::isfinite(length) && length > 1e-30;
    changed += usable && std::abs(length - 1) > 1e-3;
    n = usable ? vec3(dvec3(n) / length) : vec3(0);
  }
  return changed;
}

// Scans all pieces, says what stands before each, and returns what the whole text holds.
ObjCounts scan_pieces(TaskPool& pool, std::vector<ObjPiece>& pieces) {
  pool.for_ranges(pieces.size(), 1,
                  [&](std::size_t i, std::size_t) { pieces[i].scan = scan_obj(pieces[i].text); });
  ObjCounts all;
  for (ObjPiece& piece : pieces) {
    piece.before = all;
    all.positions += piece.scan.counts.positions;
    all.uvs += piece.scan.counts.uvs;
    all.normals += piece.scan.counts.normals;
  }
  return all;
}

// What the pieces' faces belong to. A group may be continued: its name is what makes it one; it counts from
// its first face on. A material's library may stand anywhere in the file.
std::vector<std::vector<FaceRun>> face_runs(const std::vector<ObjPiece>& pieces,
                                            const ObjMaterials& materials, std::vector<std::string>& groups) {
  std::map<std::string, std::uint32_t> group_of_name;
  std::string group;
  std::uint32_t material = TriangleMesh::no_material;
  std::vector<std::vector<FaceRun>> runs(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    std::size_t begin = 0;
    const auto run_to = [&](std::size_t end) {
      if (end == begin) return;
      const auto [place, fresh] = group_of_name.try_emplace(group, std::uint32_t(groups.size()));
      if (fresh) groups.push_back(group);
      runs[p].push_back({begin, place->second, material});
      begin = end;
    };
    for (const ObjPiece::Change& change : pieces[p].changes) {
      run_to(change.face);
      if (change.material)
        material = materials.find(change.name);
      else
        group = change.name;
    }
    run_to(pieces[p].face_sizes.size());
  }
  return runs;
}

}  // namespace

TriangleMesh load_obj(const std::filesystem::path& path, const MeshAttributes& want,
                      std::size_t piece_bytes) {
  const std::string name = path.string();
  LargeVector<char> bytes = read_text(path);
  const std::string_view text(bytes.data(), bytes.size());
  std::vector<ObjPiece> pieces;
  for (const std::string_view piece : obj_pieces(text, piece_bytes)) pieces.emplace_back().text = piece;
  TaskPool pool(unsigned(std::min<std::size_t>(threads_to_use(), std::max<std::size_t>(pieces.size(), 1))));

  const ObjCounts all = scan_pieces(pool, pieces);
  TriangleMesh mesh;
  mesh.positions.resize(all.positions);
  mesh.normals.resize(want.normals ? all.normals : 0);
  mesh.uvs.resize(want.uvs ? all.uvs : 0);
  std::atomic<bool> good =
      std::all_of(pieces.begin(), pieces.end(), [](const ObjPiece& p) { return p.scan.readable; });
  std::atomic<std::uint64_t> normalised = 0;
  if (good)
    pool.for_ranges(pieces.size(), 1, [&](std::size_t i, std::size_t) {
      ObjPiece& piece = pieces[i];
      if (!read_obj_piece(piece, all, mesh)) good = false;
      if (want.normals)
        normalised +=
            normalise(mesh.normals, piece.before.normals, piece.before.normals + piece.scan.counts.normals);
    });
  if (!good) {
    const std::string fault = first_obj_fault(text, name);
    throw Error(ExitCode::scene, fault.empty() ? name + ": a face cannot be read" : fault);
  }
  mesh.report.normals_normalised = normalised;
  LargeVector<char>().swap(bytes);

  std::vector<std::string> libraries;
  if (want.materials)
    for (const ObjPiece& piece : pieces)
      libraries.insert(libraries.end(), piece.scan.libraries.begin(), piece.scan.libraries.end());
  ObjMaterials materials = load_obj_materials(path.parent_path(), libraries);
  std::vector<std::string> groups;
  const std::vector<std::vector<FaceRun>> runs = face_runs(pieces, materials, groups);
  mesh.materials = std::move(materials.materials);
  if (want.groups) mesh.groups = std::move(groups);

  std::vector<TriangleMesh> parts(pieces.size());
  pool.for_ranges(pieces.size(), 1, [&](std::size_t i, std::size_t) {
    parts[i] = obj_triangles(pieces[i], runs[i], mesh, want);
    std::vector<ObjCorner>().swap(pieces[i].corners);
  });
  for (const ObjPiece& piece : pieces)
    for (const std::uint32_t i : piece.scan.non_finite_positions)
      mesh.positions[piece.before.positions + i].x = std::numeric_limits<float>::quiet_NaN();
  pool.for_ranges(parts.size(), 1,
                  [&](std::size_t i, std::size_t) { finish_triangles(parts[i], mesh.positions); });
  join_triangles(mesh, parts);

  if (mesh.report.normals_replaced == 3 * mesh.triangles.size()) {
    mesh.normals.clear();
    mesh.triangle_normals.clear();
    mesh.report.normals_replaced = 0;
  }
  const auto no_uv = [](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [](std::uint32_t i) { return i == TriangleMesh::no_uv; });
  };
  if (std::all_of(mesh.triangle_uvs.begin(), mesh.triangle_uvs.end(), no_uv)) mesh.triangle_uvs.clear();
  if (mesh.triangles.empty())
    throw Error(ExitCode::scene,
                mesh.report.non_finite_dropped
                    ? fmt::format("{}: no triangle is left ({} have NaN or infinite vertices)", name,
                                  mesh.report.non_finite_dropped)
                    : fmt::format("{}: the mesh has no triangles", name));
  return mesh;
}

}  // namespace nook
