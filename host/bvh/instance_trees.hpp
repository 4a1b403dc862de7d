#pragma once

#include <span>
#include <vector>

#include "bvh/bvh.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Leaves that name the things [0, names.size()) name names[i] in place of i.
void rename_triangles(Bvh& bvh, std::span<const nook_uint> names);

/// One Bvh of the trees of a mesh's models (by model; their indices start at 0) and a tree over its
/// instances.
Bvh join_trees(const TriangleMesh& mesh, std::vector<Bvh> models, const BvhOptions& options);

}  // namespace nook
