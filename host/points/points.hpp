#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "kernels/shared/surface_point.h"
#include "math/bounds.hpp"

namespace nook {

/// A surface point for the occlusion kernel. Its rays start off the surface by the distance that float
/// positions of the scene
/// (`bounds`) leave uncertain: pbrt's gamma(7) times the largest coordinate, along the normal (pbrt-v4,
/// section 6.8). normal: unit; view: unit, towards the viewer, or 0 where no effect reads it.
SurfacePoint surface_point(const vec3& position, const vec3& normal, const vec3& view, const Bounds3& bounds);

/// Reads rows `px,py,pz,nx,ny,nz[,vx,vy,vz]`, separated by commas or blanks; a first row of names, empty
/// lines and lines starting with # are skipped. Normals and views are normalised. Throws Error(scene)
/// "<file>:<row>: ..." for a row that is not finite numbers, has another count of columns, a zero normal, or
/// (needs_view) no or a zero view, and if there is no row.
std::vector<SurfacePoint> load_points(const std::filesystem::path& path, bool needs_view,
                                      const Bounds3& bounds);

/// The same from a stream, which messages call `name`.
std::vector<SurfacePoint> read_points(std::istream& in, const std::string& name, bool needs_view,
                                      const Bounds3& bounds);

}  // namespace nook
