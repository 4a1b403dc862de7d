#pragma once

#include <tiny_obj_loader.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/obj_scan.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// One piece of an OBJ text (obj_pieces), and what tinyobjloader reads in it. Pieces are read at the same
/// time: where a piece's elements begin is known from scans of all of them.
struct ObjPiece {
  std::string_view text;
  ObjScan scan;
  ObjCounts before;  ///< of the pieces above it

  /// The faces' corners, one face's behind the other's: 0-based over the whole text, -1 for what a corner has
  /// not. Faces of fewer than three corners are left out.
  std::vector<tinyobj::index_t> corners;
  std::vector<std::uint32_t> face_sizes;  ///< corners of each face

  /// A line that says what the faces from `face` on belong to.
  struct Change {
    std::size_t face = 0;   ///< index into face_sizes
    bool material = false;  ///< `name` is a material's; else a group's or object's
    std::string name;
  };
  std::vector<Change> changes;
  std::vector<std::string> libraries;  ///< material libraries that are regular files
};

/// Reads the piece's text: faces into `piece`; positions, and normals and uvs unless those arrays are empty,
/// into their places in `mesh`, which has room for `all` that the text holds. `folder` is that of material
/// libraries; null: they are not looked for. False: something cannot be read, or an index names nothing
/// (first_obj_fault says which).
bool read_obj_piece(ObjPiece& piece, const ObjCounts& all, const std::filesystem::path* folder,
                    TriangleMesh& mesh);

}  // namespace nook
