#pragma once

#include <vector>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// The normal of each position: the mean of its corners' normals, each weighted by the corner's angle
/// (Thürmer and Wüthrich 1998); a corner without a vertex normal counts with its triangle's. Unit length; 0
/// for a position that no triangle uses.
std::vector<vec3> position_normals(const TriangleMesh& mesh);

/// A surface point for each position of the mesh, in order, for OcclusionTracer::estimate_points; one that no
/// triangle uses is no hit. It belongs to the first triangle that uses it.
std::vector<SurfacePoint> vertex_points(const TriangleMesh& mesh, const std::vector<vec3>& normals);

}  // namespace nook
