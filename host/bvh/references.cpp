#include "bvh/references.hpp"

#include "kernels/shared/bvh.h"

#include <vector>

namespace nook {
namespace {

constexpr std::size_t piece = 1 << 15;  // pairs a task

}  // namespace

References make_references(const TriangleMesh& mesh, TaskPool& pool) {
  const std::vector<TrianglePair> pairs = pair_triangles(mesh, pool);
  References references;
  references.values.resize(pairs.size());
  std::vector<Span4> spans((pairs.size() + piece - 1) / piece);
  pool.for_ranges(pairs.size(), piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh.triangles[pairs[i].first];
      const vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      vec3 lo = glm::min(glm::min(a, b), c), hi = glm::max(glm::max(a, b), c);
      if (pairs[i].second != BVH_EMPTY) {
        const vec3& d = mesh.positions[mesh.triangles[pairs[i].second][1]];
        lo = glm::min(lo, d);
        hi = glm::max(hi, d);
      }
      references.values[i] = {{lo.x, lo.y, lo.z}, pairs[i].first, {hi.x, hi.y, hi.z}, pairs[i].second};
      spans[begin / piece].add(references.values[i]);
    }
  });
  for (const Span4& span : spans) references.span.add(span);
  return references;
}

}  // namespace nook
