#pragma once

#include <span>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Rays of a point that lies on a surface must start on one side of it. Points that were given or baked may
/// lie on several: on their own, whose corners are rounded, so that the point may be beneath it; on a wall
/// beside a floor, or on the floor under a box. The origins of those that lie on triangles, within the
/// rounding of their corners, are moved:
///   - without `centroids` (probes): to the side that the triangle faces, or to the normal's where it faces
///     the contrary of it;
///   - with them, the middle of each point's own surface: 2^-16 of the way there, along the surface; then to
///   the
///     side of the triangle where the middle lies. What is seen is the limit from outside of the other
///     surface. Where its own surface lies in the triangle's plane: to the side that the triangle faces.
/// `own`: of a bake to vertices, each point's position in the mesh, whose triangles are its own; otherwise
/// its own is SurfacePoint::triangle. Points without SURFACE_HIT are left alone.
void move_outside(std::span<SurfacePoint> points, const TriangleMesh& mesh,
                  std::span<const dvec3> centroids = {}, std::span<const std::uint32_t> own = {});

}  // namespace nook
