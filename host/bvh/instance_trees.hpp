#pragma once

#include <vector>

#include "bvh/bvh.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// One Bvh of the trees of a mesh's parts (by part; their indices start at 0) and a tree over its instances.
Bvh join_trees(const TriangleMesh& mesh, std::vector<Bvh> parts, const BvhOptions& options);

}  // namespace nook
