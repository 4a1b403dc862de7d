#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// An affine, invertible transform as host and kernels apply it: rounded to floats once, the normals' rows
/// scaled to a largest entry of 1. Its triangles are not numbered yet.
PlacedMesh placed_mesh(const glm::dmat4& transform);

/// Whether the transform turns a triangle's winding round, seen from the side of its normals.
bool mirrors(const glm::dmat4& transform);

/// The same bits that the kernels compute (kernels/shared/instance.h).
vec3 placed_position(const PlacedMesh& place, const vec3& p);
vec3 placed_normal(const PlacedMesh& place, const vec3& n);

/// A box that holds placed_position() of every point of `box`: of the points at its corners the bounds are
/// exact.
Bounds3 placed_bounds(const PlacedMesh& place, const Bounds3& box);

/// Appends a copy of `model`, its positions and normals placed by `transform`. A transform that mirrors turns
/// the triangles' winding round, so that they face the same way as their normals. A model without vertex
/// normals shades with geometric normals in the whole as well. Of texture coordinates, materials and groups
/// each model has its own, or none (index 0xffffffff). Throws Error(scene) if positions or indices leave
/// their range.
void append_instance(TriangleMesh& whole, const TriangleMesh& model, const glm::dmat4& transform);

/// Appends `model` as it is to a mesh that is made of models alone, wound the other way round if it is
/// `mirrored`; it is nowhere yet. Returns its index in TriangleMesh::models. Throws as append_instance().
std::uint32_t append_model(TriangleMesh& whole, const TriangleMesh& model, bool mirrored);

/// Places a model that was appended with mirrors(transform). What it stands for is append_instance() of the
/// model, to the bit. Throws Error(scene) if positions or the number of triangles leave their range.
void place_model(TriangleMesh& whole, std::uint32_t model, const glm::dmat4& transform);

/// Adds the ground: a square at `height` along the axis of `up` (world units) that reaches `reach` to all
/// sides of the mesh's center, facing `up`. It belongs to neither a material nor, if there are groups, any
/// group but its own, "ground"; TriangleMesh::subject keeps the bounds without it.
void append_ground(TriangleMesh& mesh, float height, float reach, Axis up = Axis::y);

}  // namespace nook
