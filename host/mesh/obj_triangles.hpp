#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/obj_loader.hpp"
#include "mesh/obj_piece.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// What a piece's faces from `first_face` to the next run's belong to: indices of the whole mesh.
struct FaceRun {
  std::size_t first_face = 0;
  std::uint32_t group = 0, material = 0;
};

/// The piece's faces as triangles, cut as tinyobjloader cuts them, without those that have a vertex which is
/// not finite; indices are those of `mesh`, whose elements have all been read. `runs` begin at face 0.
TriangleMesh obj_triangles(const ObjPiece& piece, const std::vector<FaceRun>& runs, const TriangleMesh& mesh,
                           const MeshAttributes& want);

/// Appends triangles, what each of them has, bounds and counts; `part` has no elements of its own.
void append_triangles(TriangleMesh& mesh, const TriangleMesh& part);

}  // namespace nook
