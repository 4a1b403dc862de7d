#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/obj_scan.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A face's corner: 0-based indices over the whole text, -1 for what it has not.
struct ObjCorner {
  std::int32_t position = -1, uv = -1, normal = -1;
};

/// One piece of an OBJ text (obj_pieces), and what tinyobjloader reads in it. Pieces are read at the same
/// time: where a piece's elements begin is known from scans of all of them.
struct ObjPiece {
  std::string_view text;  ///< not the piece's own
  ObjScan scan;
  ObjCounts before;  ///< of the pieces above it

  /// One face's behind the other's. Faces of fewer than three corners are left out.
  std::vector<ObjCorner> corners;
  std::vector<std::uint32_t> face_sizes;  ///< corners of each face

  /// A line that says what the faces from `face` on belong to.
  struct Change {
    std::size_t face = 0;   ///< index into face_sizes
    bool material = false;  ///< `name` is a material's; else a group's or object's
    std::string name;
  };
  std::vector<Change> changes;
};

/// Reads the piece's text: faces into `piece`; positions, and normals and uvs unless those arrays are empty,
/// into their places in `mesh`, which has room for `all` that the text holds. A position that is not finite
/// keeps what tinyobjloader makes of it: faces are cut by that. False: something cannot be read,
/// or an index names nothing (first_obj_fault says which).
bool read_obj_piece(ObjPiece& piece, const ObjCounts& all, TriangleMesh& mesh);

}  // namespace nook
