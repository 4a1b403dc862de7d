#pragma once

#include <cstdint>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A point of a triangle of the mesh, to bake at.
struct TrianglePoint {
  vec3 position{0}, normal{0};
  SurfacePoint point{};
  dvec3 centroid{0};  ///< of the triangle, for move_outside()
};

/// The triangle's normal, unit; 0 of one without an area.
dvec3 face_normal(const TriangleMesh& mesh, std::size_t triangle);

/// The point with barycentrics `weights`, interpolated in double precision; its normal is the vertex
/// normals', interpolated, or the triangle's, which must have an area.
TrianglePoint triangle_point(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& weights);

}  // namespace nook
