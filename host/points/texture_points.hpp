#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// The part of a square texture that a mesh's triangles cover, a surface point for each of its texels. Texel
/// (x, y) of `size` x `size` has its centre at u = (x + 1/2) / size, v = 1 - (y + 1/2) / size: row 0 is the
/// top.
struct TexturePoints {
  int size = 0;
  std::vector<std::uint32_t> texels;  ///< y * size + x, ascending
  std::vector<vec3> positions, normals;
  std::vector<SurfacePoint> points;
  std::uint64_t overlapping = 0;  ///< texels whose centre lies within more than one triangle
  std::uint64_t without_uv = 0;   ///< triangles that lack a texture coordinate, and are left out
};

/// A texel belongs to the triangle that its centre lies in (the first in the mesh, where they overlap). One
/// whose centre lies in none, but within half a texel's diagonal of a triangle, belongs to the nearest, at
/// the nearest point of it: every texel that a triangle touches is covered. Positions are interpolated in
/// double precision; normals are the vertex normals, interpolated, or the triangle's. Throws Error(scene) if
/// no triangle has texture coordinates, or they leave 0 to 1 by more than half a texel.
TexturePoints texture_points(const TriangleMesh& mesh, int size);

inline constexpr std::uint32_t no_texel = 0xffffffffu;

/// Where each texel of size x size takes its value from: a covered one from itself, one within `rings` steps
/// of one from the nearest (of equally near ones the first), others from none (no_texel). A texture filter
/// then reads no background beside a seam.
std::vector<std::uint32_t> dilation_sources(const std::vector<std::uint32_t>& covered, int size, int rings);

}  // namespace nook
