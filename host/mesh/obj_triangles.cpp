#include "mesh/obj_triangles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <istream>
#include <iterator>
#include <sstream>

namespace nook {
namespace {

// A triangle's corners: indices into ObjPiece::corners.
using Corners = std::array<std::size_t, 3>;

const vec3& position_of(const ObjPiece& piece, const TriangleMesh& mesh, std::size_t corner) {
  return mesh.positions[std::size_t(piece.corners[corner].vertex_index)];
}

// tinyobjloader's cut of every face of more than four corners, which has an OBJ text of its own for it: each
// corner a vertex (nine digits give a float back), so that vertices number corners.
std::vector<Corners> cut_polygons(const ObjPiece& piece, const TriangleMesh& mesh) {
  std::string text;
  std::vector<std::size_t> corner_of;
  std::size_t first = 0;
  for (const std::uint32_t size : piece.face_sizes) {
    if (size > 4) {
      for (std::size_t k = first; k < first + size; ++k) {
        const vec3& p = position_of(piece, mesh, k);
        fmt::format_to(std::back_inserter(text), "v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
        corner_of.push_back(k);
      }
      text += 'f';
      for (std::size_t k = corner_of.size() - size; k < corner_of.size(); ++k)
        fmt::format_to(std::back_inserter(text), " {}", k + 1);
      text += '\n';
    }
    first += size;
  }
  std::vector<Corners> triangles;
  if (text.empty()) return triangles;
  std::istringstream in(text);
  tinyobj::attrib_t attrib;
  std::vector<tinyobj::shape_t> shapes;
  std::string warnings, errors;
  tinyobj::LoadObj(&attrib, &shapes, nullptr, &warnings, &errors, &in, nullptr, /*triangulate=*/true,
                   /*default_vcols_fallback=*/false);
  for (const tinyobj::shape_t& shape : shapes)
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      Corners& corners = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = corner_of[std::size_t(shape.mesh.indices[i + k].vertex_index)];
    }
  return triangles;
}

// Calls add(face, corners) for each triangle; of a face's two diagonals the shorter one cuts it.
template <class Add>
void for_each_triangle(const ObjPiece& piece, const TriangleMesh& mesh, Add add) {
  const std::vector<Corners> polygons = cut_polygons(piece, mesh);
  std::size_t c = 0, next = 0;
  for (std::size_t face = 0; face < piece.face_sizes.size(); ++face) {
    const std::uint32_t size = piece.face_sizes[face];
    if (size == 3) {
      add(face, Corners{c, c + 1, c + 2});
    } else if (size == 4) {
      const auto length2 = [&](std::size_t a, std::size_t b) {
        const vec3 e = position_of(piece, mesh, b) - position_of(piece, mesh, a);
        return e.x * e.x + e.y * e.y + e.z * e.z;
      };
      const bool first = length2(c, c + 2) < length2(c + 1, c + 3);
      add(face, first ? Corners{c, c + 1, c + 2} : Corners{c, c + 1, c + 3});
      add(face, first ? Corners{c, c + 2, c + 3} : Corners{c + 1, c + 2, c + 3});
    } else {
      for (; next < polygons.size() && polygons[next][0] < c + size; ++next) add(face, polygons[next]);
    }
    c += size;
  }
}

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::uint32_t corner_normal(const TriangleMesh& mesh, int index) {
  const bool usable = index >= 0 && mesh.normals[std::size_t(index)] != vec3(0);
  return usable ? std::uint32_t(index) : TriangleMesh::no_normal;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

TriangleMesh obj_triangles(const ObjPiece& piece, const std::vector<FaceRun>& runs, const TriangleMesh& mesh,
                           const MeshAttributes& want) {
  TriangleMesh part;
  part.triangles.reserve(piece.face_sizes.size());
  std::size_t run = 0;
  for_each_triangle(piece, mesh, [&](std::size_t face, const Corners& corners) {
    while (run + 1 < runs.size() && runs[run + 1].first_face <= face) ++run;
    ++part.report.triangles_read;
    std::array<std::uint32_t, 3> position{}, normal{}, uv{};
    bool kept = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const tinyobj::index_t& corner = piece.corners[corners[k]];
      position[k] = std::uint32_t(corner.vertex_index);
      normal[k] = want.normals ? corner_normal(mesh, corner.normal_index) : 0;
      uv[k] = std::uint32_t(corner.texcoord_index);
      kept = kept && finite(mesh.positions[position[k]]);
    }
    if (!kept) {
      ++part.report.non_finite_dropped;
      return;
    }
    part.triangles.push_back(position);
    if (want.normals) part.triangle_normals.push_back(normal);
    if (want.uvs) part.triangle_uvs.push_back(uv);
    if (want.materials) part.triangle_material.push_back(runs[run].material);
    if (want.groups) part.triangle_group.push_back(runs[run].group);
    for (const std::uint32_t index : position) part.bounds.add(mesh.positions[index]);
    for (const std::uint32_t n : normal) part.report.normals_replaced += n == TriangleMesh::no_normal;
  });
  return part;
}

void append_triangles(TriangleMesh& mesh, const TriangleMesh& part) {
  append(mesh.triangles, part.triangles);
  append(mesh.triangle_normals, part.triangle_normals);
  append(mesh.triangle_uvs, part.triangle_uvs);
  append(mesh.triangle_material, part.triangle_material);
  append(mesh.triangle_group, part.triangle_group);
  mesh.bounds.add(part.bounds);
  mesh.report.triangles_read += part.report.triangles_read;
  mesh.report.non_finite_dropped += part.report.non_finite_dropped;
  mesh.report.normals_replaced += part.report.normals_replaced;
}

}  // namespace nook
