#pragma once

#include <cstdint>

#include "bvh/binary_tree.hpp"
#include "bvh/bvh.hpp"

namespace nook {

/// A leaf without triangles.
TriangleLeaf empty_leaf();

/// The leaf of the pairs below the binary tree's node `root`, at most BVH_LEAF_PAIRS of them: the corners of
/// pair i are those of lane i, and of lane i + BVH_LEAF_PAIRS for its second triangle.
TriangleLeaf triangle_leaf(const BinaryTree& tree, const TriangleMesh& mesh, std::uint32_t root);

}  // namespace nook
