#include "mesh/obj_triangles.hpp"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <istream>
#include <iterator>
#include <sstream>
#include <type_traits>

#include "mesh/corner_order.hpp"

namespace nook {
namespace {

// A triangle's corners: indices into ObjPiece::corners.
using Corners = std::array<std::size_t, 3>;

const vec3& position_of(const ObjPiece& piece, const TriangleMesh& mesh, std::size_t corner) {
  return mesh.positions[std::size_t(piece.corners[corner].position)];
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

std::uint32_t corner_normal(const TriangleMesh& mesh, int index) {
  const bool usable = index >= 0 && mesh.normals[std::size_t(index)] != vec3(0);
  return usable ? std::uint32_t(index) : TriangleMesh::no_normal;
}

// Calls visit(array) for each of the arrays that have an entry a triangle.
template <class Visit>
void for_each_array(Visit visit) {
  visit(&TriangleMesh::triangles);
  visit(&TriangleMesh::triangle_normals);
  visit(&TriangleMesh::triangle_uvs);
  visit(&TriangleMesh::triangle_material);
  visit(&TriangleMesh::triangle_group);
}

}  // namespace

TriangleMesh obj_triangles(const ObjPiece& piece, const std::vector<FaceRun>& runs, const TriangleMesh& mesh,
                           const MeshAttributes& want) {
  TriangleMesh part;
  part.triangles.reserve(piece.face_sizes.size());
  std::size_t run = 0;
  for_each_triangle(piece, mesh, [&](std::size_t face, const Corners& corners) {
    while (run + 1 < runs.size() && runs[run + 1].first_face <= face) ++run;
    std::array<std::uint32_t, 3> position{}, normal{}, uv{};
    for (std::size_t k = 0; k < 3; ++k) {
      const ObjCorner& corner = piece.corners[corners[k]];
      position[k] = std::uint32_t(corner.position);
      normal[k] = want.normals ? corner_normal(mesh, corner.normal) : 0;
      uv[k] = std::uint32_t(corner.uv);
    }
    part.triangles.push_back(position);
    if (want.normals) part.triangle_normals.push_back(normal);
    if (want.uvs) part.triangle_uvs.push_back(uv);
    if (want.materials) part.triangle_material.push_back(runs[run].material);
    if (want.groups) part.triangle_group.push_back(runs[run].group);
  });
  return part;
}

void finish_triangles(TriangleMesh& part, const std::vector<vec3>& positions) {
  const std::size_t count = part.triangles.size();
  std::vector<std::uint32_t> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = part.triangles[i];
    if (!finite(positions[a]) || !finite(positions[b]) || !finite(positions[c])) continue;
    kept.push_back(std::uint32_t(i));
    for (const std::uint32_t index : {a, b, c}) part.bounds.add(positions[index]);
  }
  part.report.triangles_read = count;
  part.report.non_finite_dropped = count - kept.size();
  for_each_array([&](auto array) {
    auto& values = part.*array;
    if (values.empty() || kept.size() == count) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
  });
  for (const auto& corners : part.triangle_normals)
    for (const std::uint32_t n : corners) part.report.normals_replaced += n == TriangleMesh::no_normal;
  end_with_longest_edges(part, positions);
}

void join_triangles(TriangleMesh& mesh, std::vector<TriangleMesh>& parts) {
  for_each_array([&](auto array) {
    std::size_t total = 0;
    for (const TriangleMesh& part : parts) total += (part.*array).size();
    auto& whole = mesh.*array;
    whole.reserve(total);
    for (TriangleMesh& part : parts) {
      whole.insert(whole.end(), (part.*array).begin(), (part.*array).end());
      std::remove_reference_t<decltype(whole)>().swap(part.*array);
    }
  });
  for (const TriangleMesh& part : parts) {
    mesh.bounds.add(part.bounds);
    mesh.report.triangles_read += part.report.triangles_read;
    mesh.report.non_finite_dropped += part.report.non_finite_dropped;
    mesh.report.normals_replaced += part.report.normals_replaced;
  }
}

}  // namespace nook
