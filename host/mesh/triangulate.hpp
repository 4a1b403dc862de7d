#pragma once

#include "mesh/polygon_mesh.hpp"

namespace nook {

/// The mesh that is rendered: positions as floats, faces cut (face_cut.hpp), unit normals, triangles with a
/// position that is not finite dropped and counted, each triangle turned (corner_order.hpp). What `want` does
/// not name is left out. The process's threads (threads_to_use) work at it, and how many they are changes
/// nothing. Throws Error(scene) if no triangle is left.
TriangleMesh triangulated(PolygonMesh&& polygons, const MeshAttributes& want);

}  // namespace nook
