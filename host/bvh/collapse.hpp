#pragma once

#include "bvh/binary_tree.hpp"
#include "bvh/bvh.hpp"

namespace nook {

/// Collapses a binary tree into nodes of `width` children and leaves of up to BVH_LEAF_PAIRS pairs,
/// such that the expected cost of a ray under the surface area heuristic is the least that this binary tree
/// allows (dynamic programming over the number of roots that stand for a subtree; Wald, Benthin, Boulos,
/// "Getting Rid of Packets", 2008; Ylitie, Karras, Laine, HPG 2017). A leaf costs the same whatever its
/// number of pairs. Returns nodes, leaves and their statistics, build time excepted; the same whatever
/// the number of threads.
Bvh collapse(const BinaryTree& tree, const TriangleMesh& mesh, unsigned width, TaskPool& pool);

}  // namespace nook
