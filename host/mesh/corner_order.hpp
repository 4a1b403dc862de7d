#pragma once

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Turns each triangle, winding kept, so that its longest edge is from its last corner to its first.
/// Neighbours across an edge that is the longest of both then share a place in the tree
/// (bvh/triangle_pairs.hpp). What a triangle's arithmetic comes to depends on its first corner, so the order
/// is the mesh's, not a tree's.
void end_with_longest_edges(TriangleMesh& mesh);
/// The same where the triangles' positions are another array.
void end_with_longest_edges(TriangleMesh& triangles, const std::vector<vec3>& positions);

}  // namespace nook
