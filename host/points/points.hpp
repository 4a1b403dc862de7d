#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "kernels/shared/surface_point.h"
#include "math/frame.hpp"
#include "math/types.hpp"

namespace nook {

/// v / |v|, of a vector of any length; 0 of 0.
vec3 unit(const dvec3& v);

/// A surface point for the occlusion kernel. Its rays start off the surface by what rounding the point may
/// move it: four half ulps of its coordinates along `off`, each rounded outwards, and sixteen of `extent`, a
/// length that is small for the surface about it. normal: unit, the one directions are drawn about; off:
/// unit, of the surface, on the normal's side; view: unit, towards the viewer, or 0 where no effect reads it.
SurfacePoint surface_point(const vec3& position, const vec3& normal, const vec3& view, const vec3& off,
                           float extent);

/// Of a point that is given: the same along `normal`, of no triangle.
SurfacePoint surface_point(const vec3& position, const vec3& normal, const vec3& view);

/// Reads points of a file's coordinates into a mesh's in memory, rows `px,py,pz,nx,ny,nz[,vx,vy,vz]`,
/// separated by commas or blanks; a first row of names, empty lines and lines starting with # are skipped.
/// Normals and views are normalised. Throws Error(scene)
/// "<file>:<row>: ..." for a row that is not finite numbers, has another count of columns, a zero normal, or
/// (needs_view) no or a zero view, and if there is no row.
std::vector<SurfacePoint> load_points(const std::filesystem::path& path, bool needs_view,
                                      const Frame& frame = {});

/// The same from a stream, which messages call `name`.
std::vector<SurfacePoint> read_points(std::istream& in, const std::string& name, bool needs_view,
                                      const Frame& frame = {});

}  // namespace nook
