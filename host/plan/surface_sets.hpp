#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bvh/bvh.hpp"
#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// A bit for each triangle of a mesh, 32 in a word, as the kernels read them.
using TriangleBits = std::vector<std::uint32_t>;

/// The triangles whose OBJ group or whose material has one of the names. `key`: of the scene, for the
/// message. Throws Error(scene) for a name that is neither, naming those that are.
TriangleBits named_triangles(const Scene& scene, const TriangleMesh& mesh, const std::string& key,
                             const std::vector<std::string>& names);

/// The indices of the bits that are set, ascending.
std::vector<std::uint32_t> triangles_of(const TriangleBits& bits);

/// A tree over each group's triangles, in one pair of buffers: for effects of `occluders = "self"`. Node and
/// leaf indices of a group's tree count from its first ones. `width`: BvhOptions::width.
struct GroupTrees {
  Bvh trees;
  std::vector<std::uint32_t> first;  ///< of each group: its first node, its first leaf
};
GroupTrees build_group_trees(const TriangleMesh& mesh, unsigned width);

}  // namespace nook
