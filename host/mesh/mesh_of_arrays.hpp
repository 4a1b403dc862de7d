#pragma once

#include <cstdint>
#include <span>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A mesh given as arrays: `positions` has x, y, z of each vertex, world units; `triangles` the indices of
/// three vertices each, counter-clockwise seen from the front. `normals`: x, y, z of each vertex, of any
/// length, or empty for geometric normals. Throws Error(scene) that says which entry is wrong: sizes that are
/// no multiples of three, an index out of range, a position or normal that is not finite, no triangle.
TriangleMesh mesh_of_arrays(std::span<const float> positions, std::span<const std::uint32_t> triangles,
                            std::span<const float> normals = {});
/// The same of doubles: coordinates far from 0 keep their digits (TriangleMesh::frame).
TriangleMesh mesh_of_arrays(std::span<const double> positions, std::span<const std::uint32_t> triangles,
                            std::span<const float> normals = {});

}  // namespace nook
