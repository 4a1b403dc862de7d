#pragma once

#include <vector>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// The corners of a mesh's triangles, three each in the mesh's order: each with its own normal, the
/// triangle's where it has none, and of its own triangle alone. So a hard edge has a value on either side.
struct CornerPoints {
  std::vector<vec3> normals;  ///< 0 of triangles without an area, whose points are no hits
  std::vector<SurfacePoint> points;
};
CornerPoints corner_points(const TriangleMesh& mesh);

/// The mesh with a position for each corner of its triangles: what corners' values are written with. The
/// positions and triangles alone.
TriangleMesh corner_mesh(const TriangleMesh& mesh);

}  // namespace nook
