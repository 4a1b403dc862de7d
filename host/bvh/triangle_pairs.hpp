#pragma once

#include <cstdint>
#include <vector>

#include "base/task_pool.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// What one place of a TriangleLeaf holds: a triangle (a, b, c), and (c, d, a) on the other side of the edge
/// that both end with, or BVH_EMPTY. Indices in the mesh.
struct TrianglePair {
  std::uint32_t first, second;
};

/// The triangles of the mesh that a ray can hit, each once: finite vertices, and no two of them the same.
/// Pairs are, at most, those whose last edges are between the same two points, in opposite directions, and
/// whose box is not larger than the two boxes; each comes in the order of its first triangle, the lower
/// index. The same with any number of threads.
std::vector<TrianglePair> pair_triangles(const TriangleMesh& mesh, TaskPool& pool);

}  // namespace nook
