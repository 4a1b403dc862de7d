#pragma once

#include "base/task_pool.hpp"
#include "bvh/binary_tree.hpp"

namespace nook {

/// The tree with its largest subtrees moved to where they enlarge the boxes least: what splitting from the
/// root down decides too early is decided again with all boxes known (Bittner, Hapala, Havran, "Fast
/// Insertion-Based Optimization of Bounding Volume Hierarchies", CGF 2013; here subtrees are taken by falling
/// area, and only the tree's upper part is searched). The same whatever the pool's number of threads.
BinaryTree reinsert_subtrees(const BinaryTree& tree, TaskPool& pool);

}  // namespace nook
