#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/obj_text.hpp"
#include "mesh/polygon_mesh.hpp"

namespace nook {

/// One piece of an OBJ text (obj_pieces). Pieces are read at the same time: where a piece's elements begin is
/// known from counts of all of them.
struct ObjPiece {
  std::string_view text;     ///< not the piece's own
  ObjCounts counts, before;  ///< of the piece, and of the pieces above it

  FaceBlock block;  ///< its faces, of three corners and more; runs are not known yet

  /// A line that is no element: what the faces from `face` on belong to, or where materials are.
  struct Change {
    enum class Kind { group, object, material, library } kind;
    std::size_t face;  ///< index into block.face_sizes
    std::size_t line;  ///< in the whole text
    std::string text;  ///< what follows the keyword
  };
  std::vector<Change> changes;

  std::string fault;            ///< what is wrong with the first line that cannot be read; or empty
  std::size_t fault_line = 0;   ///< that line of the file, from 1
  std::size_t odd_uvs = 0;      ///< `vt` lines whose numbers are not finite
  std::size_t odd_uv_line = 0;  ///< the first of them
};

/// Reads the piece's text: faces into `piece`; positions, and normals and uvs if `want` names them, into
/// their places in `mesh`, which has room for `all` that the text holds.
void read_obj_piece(ObjPiece& piece, const ObjCounts& all, const MeshAttributes& want, PolygonMesh& mesh);

}  // namespace nook
