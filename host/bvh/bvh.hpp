#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "base/large_vector.hpp"
#include "kernels/shared/bvh.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

struct BvhOptions {
  unsigned threads = 0;  ///< 0: all
  unsigned width = 16;   ///< children of a node: 8 or 16
  bool refined = false;  ///< up to some 26 ms more, for rays that take up to a tenth less (reinsertion.hpp)
};

template <unsigned Width>
using BvhNodes = LargeVector<BvhNode<Width>>;

/// A wide bounding volume hierarchy, flattened into the structs of kernels/shared/bvh.h, ready to upload. Of
/// a mesh with instances: a tree over them, whose leaves name instances instead of triangles (point i
/// and point i + 8 are the corners of the i-th box), and in the same arrays a tree for each model.
struct Bvh {
  /// The first is the root; without triangles it has no children.
  std::variant<BvhNodes<16>, BvhNodes<8>> nodes;
  LargeVector<TriangleLeaf> leaves;   ///< never empty, since a buffer cannot be
  std::vector<PlacedMesh> instances;  ///< the mesh's, complete; empty without
  struct Statistics {
    double build_seconds = 0;
    double collapse_seconds = 0;
    unsigned depth = 0;  ///< levels, for the traversal stack's size
    double sah_cost = 0;
    double triangles_per_leaf = 0;
  } statistics;

  unsigned width() const { return std::holds_alternative<BvhNodes<8>>(nodes) ? 8 : 16; }
  std::size_t node_bytes() const {
    return std::visit([](const auto& all) { return all.size() * sizeof(all[0]); }, nodes);
  }
  std::size_t bytes() const {
    return node_bytes() + leaves.size() * sizeof(TriangleLeaf) + instances.size() * sizeof(PlacedMesh);
  }
};

/// Throws Error(device) if the arrays are longer than a node can point into: 2^27, of some 600 million
/// triangles.
void check_bvh_size(std::size_t nodes, std::size_t leaves);

/// Builds over all triangles of non-zero extent and finite vertices. Deterministic: the same mesh gives the
/// same bytes whatever the thread count. Throws Error(device) if memory runs out.
Bvh build_bvh(const TriangleMesh& mesh, const BvhOptions& options = {});

/// The same over some of the mesh's triangles: their indices in the mesh, ascending.
Bvh build_bvh(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
              const BvhOptions& options = {});

}  // namespace nook
