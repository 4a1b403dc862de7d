#pragma once

#include <cstddef>
#include <filesystem>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Reads a Wavefront OBJ file (obj_piece.hpp, triangulate.hpp), in pieces of some `piece_bytes` that the
/// process's threads (threads_to_use) read at the same time; their size changes nothing in the mesh.
/// Throws Error(scene) with one line: missing file, not a regular file, no triangles; or, with its line, a
/// number or face that cannot be read, an index that names nothing.
TriangleMesh load_obj(const std::filesystem::path& path, const MeshAttributes& attributes = {},
                      std::size_t piece_bytes = std::size_t(1) << 21);

}  // namespace nook
