#pragma once

#include <span>
#include <string>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// A line about the triangle whose corners, as floats, are too coarse for what is of interest beside it, so
/// that an effect may be off by more than .001; "" if there is none, as in ordinary scenes. How coarse a
/// triangle is, is the least distance that its place is good for (its resolution, file's units):
///   1.25 2^-17 sum |n_i| max(e_i, |p_i| / 8) + 2^-31 e,   n: unit normal, e_i: its sides, e the largest, p:
///   corners
/// that is some 1 / 80 000 of a tilted triangle and hardly anything of one along the axes, whose rounding
/// does not move it off its plane. Of interest are
///   - the effects' distance limits that are finite and above 0, and SSAO's radius (to 10^-6 of any
///   triangle);
///   - the distance from the eye, if there is a `viewer`;
///   - the extents of small triangles (below a hundredth of the largest), if more than a quarter of these lie
///     within the resolution of triangles for which that is more than their own extent;
///   - triangles' own widths, if more than half of all are narrower than that or than 10^-6 of their extent.
/// Where meshes are placed as trees, the last two are not looked for, nor all but each mesh's 16 coarsest.
std::string proportions_warning(const Scene& scene, const TriangleMesh& mesh, bool viewer);

/// The same for given points, in the coordinates of a mesh in `frame`, beside the scene's first effect's
/// distance limit. `name`: of the points' file.
std::string far_points_warning(const Scene& scene, const TriangleMesh& mesh,
                               std::span<const SurfacePoint> points, const std::string& name);

}  // namespace nook
