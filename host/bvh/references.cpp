#include "bvh/references.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nook {
namespace {

constexpr std::size_t piece = 1 << 15;  // triangles a task

bool finite(const vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Finite vertices, and no two of them the same: anything else can never be hit.
bool can_be_hit(const vec3& a, const vec3& b, const vec3& c) {
  return finite(a) && finite(b) && finite(c) && a != b && b != c && c != a;
}

}  // namespace

References make_references(const TriangleMesh& mesh, TaskPool& pool) {
  const std::size_t count = mesh.triangles.size();
  References references;
  references.values.resize(count);
  struct Piece {
    std::size_t kept = 0;
    Span4 span;
  };
  std::vector<Piece> pieces((count + piece - 1) / piece);
  pool.for_ranges(count, piece, [&](std::size_t begin, std::size_t end) {
    Piece& mine = pieces[begin / piece];
    Reference* out = references.values.data() + begin;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh.triangles[i];
      const vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      if (!can_be_hit(a, b, c)) continue;
      const vec3 lo = glm::min(glm::min(a, b), c), hi = glm::max(glm::max(a, b), c);
      const Reference r = {{lo.x, lo.y, lo.z}, std::uint32_t(i), {hi.x, hi.y, hi.z}, 0};
      out[mine.kept++] = r;
      mine.span.add(r);
    }
  });
  std::size_t kept = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Reference* from = references.values.data() + p * piece;
    if (kept != p * piece) std::copy(from, from + pieces[p].kept, references.values.data() + kept);
    kept += pieces[p].kept;
    references.span.add(pieces[p].span);
  }
  references.values.resize(kept);
  return references;
}

}  // namespace nook
