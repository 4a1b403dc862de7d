#include "mesh/block_triangles.hpp"

#include <array>
#include <cmath>

namespace nook {

TriangleMesh BlockTriangles::of(const FaceBlock& block, CrossedFaces& crossed) {
  TriangleMesh part;
  part.triangles.reserve(block.face_sizes.size());
  std::size_t corner = 0, run = 0, polygon = 0;
  for (std::size_t face = 0; face < block.face_sizes.size(); ++face) {
    while (run + 1 < block.runs.size() && block.runs[run + 1].first_face <= face) ++run;
    const std::uint32_t size = block.face_sizes[face];
    triangles_.clear();
    if (!cut(block, corner, size) && crossed.faces++ == 0) crossed.first_place = block.places[polygon];
    polygon += size > 3;
    for (const FaceCutter::Triangle& t : triangles_) add(part, block, corner, t, block.runs[run]);
    corner += size;
  }
  return part;
}

// A face with a position that is not finite becomes a fan, of which some triangles will be dropped.
bool BlockTriangles::cut(const FaceBlock& block, std::size_t first, std::uint32_t size) {
  corners_.clear();
  bool all_finite = true;
  for (std::size_t c = first; size > 3 && c < first + size; ++c) {
    all_finite = all_finite && finite(mesh_.positions[block.positions[c]]);
    corners_.push_back(polygons_.positions[block.positions[c]]);
  }
  if (size > 3 && all_finite) return cutter_.cut(corners_, triangles_);
  for (std::uint32_t k = 1; k + 1 < size; ++k) triangles_.push_back({0, k, k + 1});
  return true;
}

void BlockTriangles::add(TriangleMesh& part, const FaceBlock& block, std::size_t first,
                         const FaceCutter::Triangle& triangle, const FaceBlock::Run& run) const {
  std::array<std::uint32_t, 3> position{}, normal{}, uv{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t c = first + triangle[k];
    position[k] = block.positions[c];
    if (want_.normals) normal[k] = normal_of(block, c);
    if (want_.uvs) uv[k] = uv_of(block, c);
  }
  part.triangles.push_back(position);
  if (want_.normals) part.triangle_normals.push_back(normal);
  if (want_.uvs) part.triangle_uvs.push_back(uv);
  if (want_.materials) part.triangle_material.push_back(run.material);
  if (want_.groups) part.triangle_group.push_back(run.group);
}

std::uint32_t BlockTriangles::normal_of(const FaceBlock& block, std::size_t c) const {
  const std::uint32_t index = polygons_.vertices_have_normals ? block.positions[c]
                              : block.normals.empty()         ? FaceBlock::none
                                                              : block.normals[c];
  return index != FaceBlock::none && mesh_.normals[index] != vec3(0) ? index : TriangleMesh::no_normal;
}

std::uint32_t BlockTriangles::uv_of(const FaceBlock& block, std::size_t c) const {
  const std::uint32_t index = polygons_.vertices_have_uvs ? block.positions[c]
                              : block.uvs.empty()         ? FaceBlock::none
                                                          : block.uvs[c];
  if (index == FaceBlock::none) return TriangleMesh::no_uv;
  const vec2& uv = mesh_.uvs[index];
  return std::isfinite(uv.x) && std::isfinite(uv.y) ? index : TriangleMesh::no_uv;
}

}  // namespace nook
