#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/shared/bvh.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

struct BvhOptions {
  unsigned threads = 0;  ///< 0: all
};

/// A wide bounding volume hierarchy, flattened into the structs of kernels/shared/bvh.h, ready to upload.
struct Bvh {
  std::vector<BvhNode> nodes;           ///< nodes[0] is the root; empty if the mesh has no triangles
  std::vector<TriangleLeaf> leaves;
  struct Statistics {
    double build_seconds = 0;
    double collapse_seconds = 0;
    unsigned depth = 0;          ///< levels, for the traversal stack's size
    double sah_cost = 0;
    double triangles_per_leaf = 0;
  } statistics;

  std::size_t bytes() const { return nodes.size() * sizeof(BvhNode) + leaves.size() * sizeof(TriangleLeaf); }
};

/// Builds over all triangles of non-zero extent and finite vertices. Deterministic: the same mesh gives the same bytes
/// whatever the thread count. Throws Error(device) if memory runs out.
Bvh build_bvh(const TriangleMesh& mesh, const BvhOptions& options = {});

}  // namespace nook
