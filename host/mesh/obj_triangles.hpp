#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/obj_piece.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// What a piece's faces from `first_face` to the next run's belong to: indices of the whole mesh.
struct FaceRun {
  std::size_t first_face = 0;
  std::uint32_t group = 0, material = 0;
};

/// The piece's faces as triangles, cut as tinyobjloader cuts them; indices are those of `mesh`, whose
/// elements have all been read. `runs` begin at face 0.
TriangleMesh obj_triangles(const ObjPiece& piece, const std::vector<FaceRun>& runs, const TriangleMesh& mesh,
                           const MeshAttributes& want);

/// Drops the triangles that have a position which is not finite, and counts them; then makes part.bounds, and
/// turns the triangles (corner_order.hpp).
void finish_triangles(TriangleMesh& part, const std::vector<vec3>& positions);

/// The parts' triangles, what each of them has, bounds and counts, behind one another in `mesh`. The parts
/// are left empty.
void join_triangles(TriangleMesh& mesh, std::vector<TriangleMesh>& parts);

}  // namespace nook
