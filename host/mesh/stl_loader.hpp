#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Reads an STL file, binary or ASCII: binary is one whose size is that of the triangles it counts, whatever
/// its first word. Corners at the same place (to the bit, -0 as 0) become one vertex, so that a bake has
/// vertices that triangles share; the facets' normals are left out, since they are those of the triangles. A
/// group for each `solid` name. Throws Error(scene) with one line that says where.
TriangleMesh load_stl(const std::filesystem::path& path, const MeshAttributes& attributes = {});

}  // namespace nook
