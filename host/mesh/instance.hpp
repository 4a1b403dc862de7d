#pragma once

#include <glm/mat4x4.hpp>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Appends a copy of `part`, its positions taken through `transform` (affine, invertible) in double precision
/// and rounded once, its normals through the inverse transpose. A transform that mirrors turns the triangles'
/// winding round, so that they face the same way as their normals. A part without vertex normals shades with
/// geometric normals in the whole as well. Of texture coordinates,
/// materials and groups each part has its own, or none (index 0xffffffff). Throws Error(scene) if positions
/// or indices leave their range.
void append_instance(TriangleMesh& whole, const TriangleMesh& part, const glm::dmat4& transform);

/// Appends the ground: a square at `height` (y, world units) that reaches `reach` to all sides of the mesh's
/// center, facing up. It belongs to neither a material nor, if there are groups, any group but its own,
/// "ground"; TriangleMesh::subject keeps the bounds without it.
void append_ground(TriangleMesh& mesh, float height, float reach);

}  // namespace nook
