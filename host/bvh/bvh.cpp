#include "bvh/bvh.hpp"

#include <algorithm>
#include <chrono>
#include <new>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "base/threads.hpp"
#include "bvh/binary_tree.hpp"
#include "bvh/collapse.hpp"
#include "bvh/instance_trees.hpp"
#include "bvh/reinsertion.hpp"

namespace nook {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Bvh build(const TriangleMesh& mesh, const BvhOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  TaskPool pool(threads_to_use(options.threads));
  Bvh bvh;
  double build_seconds = 0, collapse_seconds = 0;
  struct Attempt {
    SplitRule rule;
    bool refined;
  };
  // A mesh made to be deep gets a balanced tree, so that the kernels' stack suffices.
  std::vector<Attempt> attempts = {{SplitRule::surface_area, false}, {SplitRule::median, false}};
  if (options.refined) attempts.insert(attempts.begin(), {SplitRule::surface_area, true});
  for (const Attempt& attempt : attempts) {
    BinaryTree tree = build_binary_tree(mesh, attempt.rule, pool);
    if (attempt.refined) tree = reinsert_subtrees(tree, pool);
    build_seconds = seconds_since(start);
    bvh = collapse(tree, mesh, options.width, pool);
    collapse_seconds = seconds_since(start) - build_seconds;
    if (bvh.statistics.depth <= BVH_MAX_DEPTH) break;
  }
  bvh.statistics.build_seconds = build_seconds;
  bvh.statistics.collapse_seconds = collapse_seconds;
  return bvh;
}

// Those of the mesh's triangles by themselves, with the mesh's numbers.
Bvh build_some(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
               const BvhOptions& options) {
  TriangleMesh some;
  some.positions.reserve(3 * triangles.size());
  some.triangles.reserve(triangles.size());
  for (const std::uint32_t triangle : triangles) {
    const auto first = std::uint32_t(some.positions.size());
    for (const std::uint32_t corner : mesh.triangles[triangle])
      some.positions.push_back(mesh.positions[corner]);
    some.triangles.push_back({first, first + 1, first + 2});
  }
  Bvh bvh = build(some, options);
  rename_triangles(bvh, triangles);
  return bvh;
}

// A tree for each model, over those of its triangles that are in `triangles`.
std::vector<Bvh> build_models(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                              const BvhOptions& options) {
  std::vector<Bvh> trees;
  for (const TriangleMesh::Model& model : mesh.models) {
    const auto first = std::lower_bound(triangles.begin(), triangles.end(), model.first_triangle);
    const auto end = std::lower_bound(first, triangles.end(), model.first_triangle + model.triangles);
    trees.push_back(build_some(mesh, {first, end}, options));
  }
  return trees;
}

template <class Build>
Bvh within_memory(const TriangleMesh& mesh, const Build& build) {
  try {
    return build();
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::device, "not enough memory to build the tree over " +
                                       std::to_string(mesh.triangles.size()) + " triangles");
  }
}

}  // namespace

void check_bvh_size(std::size_t nodes, std::size_t leaves) {
  if (std::max(nodes, leaves) > BVH_FIRST(~0u))
    throw Error(ErrorKind::device, "the mesh is too large: its tree has " + std::to_string(nodes) +
                                       " nodes and " + std::to_string(leaves) + " leaves, more than " +
                                       std::to_string(BVH_FIRST(~0u)));
}

Bvh build_bvh(const TriangleMesh& mesh, const BvhOptions& options) {
  return within_memory(mesh, [&] {
    if (mesh.instances.empty()) return build(mesh, options);
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return join_trees(mesh, build_models(mesh, all, options), options);
  });
}

Bvh build_bvh(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const BvhOptions& options) {
  return within_memory(mesh, [&] {
    return mesh.instances.empty() ? build_some(mesh, triangles, options)
                                  : join_trees(mesh, build_models(mesh, triangles, options), options);
  });
}

}  // namespace nook
