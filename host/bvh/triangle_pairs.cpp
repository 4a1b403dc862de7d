#include "bvh/triangle_pairs.hpp"

#include <bit>
#include <cmath>
#include <span>

#include "kernels/shared/bvh.h"

namespace nook {
namespace {

constexpr std::size_t piece = 1 << 15;  // triangles a task
constexpr std::uint32_t unpaired = BVH_EMPTY;
// Through the table: where thousands of triangles meet at one edge, most stay single.
constexpr std::size_t most_steps = 32;

// Anything else can never be hit.
bool can_be_hit(const vec3& a, const vec3& b, const vec3& c) {
  return finite(a) && finite(b) && finite(c) && a != b && b != c && c != a;
}

float half_area(const vec3& lo, const vec3& hi) {
  const vec3 e = hi - lo;
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

class Pairing {
 public:
  explicit Pairing(const TriangleMesh& mesh) : mesh_(mesh), partner_(mesh.triangles.size()) {}

  /// Pairs what it can of triangles that have no partner yet: each with the first before it that fits.
  /// They are a task's own: nothing else is written.
  void pair(std::span<const std::uint32_t> triangles) {
    const std::size_t size = std::bit_ceil(2 * triangles.size() + 1);
    std::vector<std::uint32_t> table(size, unpaired);  // triangles by their last edges, open addressing
    for (const std::uint32_t i : triangles) {
      const std::size_t first = hash(i);
      for (std::size_t step = 0; step < most_steps; ++step) {
        std::uint32_t& place = table[(first + step) & (size - 1)];
        const std::uint32_t other = place;
        if (other == unpaired) {
          place = i;
          break;
        }
        if (partner_[other] != unpaired || !fit(i, other)) continue;
        partner_[i] = other;
        partner_[other] = i;
        break;
      }
    }
  }

  std::uint32_t partner(std::size_t triangle) const { return partner_[triangle]; }

  /// Which of [begin, end) a ray can hit; the others become partners of themselves.
  std::vector<std::uint32_t> hittable(std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> list;
    list.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh_.triangles[i];
      const bool hit = can_be_hit(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
      partner_[i] = hit ? unpaired : std::uint32_t(i);
      if (hit) list.push_back(std::uint32_t(i));
    }
    return list;
  }

 private:
  const vec3& corner(std::uint32_t triangle, int k) const {
    return mesh_.positions[mesh_.triangles[triangle][k]];
  }

  // The same for an edge in either direction.
  std::size_t hash(std::uint32_t triangle) const {
    const vec3 edge = corner(triangle, 0) + corner(triangle, 2) + vec3(0);  // 0 and -0 are one
    std::uint64_t bits = std::bit_cast<std::uint32_t>(edge.x);
    for (const float axis : {edge.y, edge.z})
      bits = (bits ^ bits >> 29) * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(axis);
    return std::size_t((bits ^ bits >> 29) * 0x9e3779b97f4a7c15u >> 32);
  }

  // By the corners' places: many files have a vertex once for each of its triangles.
  bool fit(std::uint32_t i, std::uint32_t j) const {
    const vec3 &a = corner(i, 0), &b = corner(i, 1), &c = corner(i, 2), &d = corner(j, 1);
    if (a != corner(j, 2) || c != corner(j, 0)) return false;
    const vec3 edge_lo = glm::min(a, c), edge_hi = glm::max(a, c);
    return half_area(glm::min(glm::min(edge_lo, b), d), glm::max(glm::max(edge_hi, b), d)) <=
           half_area(glm::min(edge_lo, b), glm::max(edge_hi, b)) +
               half_area(glm::min(edge_lo, d), glm::max(edge_hi, d));
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> partner_;
};

}  // namespace

std::vector<TrianglePair> pair_triangles(const TriangleMesh& mesh, TaskPool& pool) {
  const std::size_t count = mesh.triangles.size(), pieces = (count + piece - 1) / piece;
  // Neighbours are mostly near each other in a mesh: first within pieces, then what is left over from all.
  Pairing pairing(mesh);
  pool.for_ranges(count, piece,
                  [&](std::size_t begin, std::size_t end) { pairing.pair(pairing.hittable(begin, end)); });
  std::vector<std::uint32_t> left_over;
  for (std::size_t i = 0; i < count; ++i)
    if (pairing.partner(i) == unpaired) left_over.push_back(std::uint32_t(i));
  if (pieces > 1) pairing.pair(left_over);
  std::vector<TrianglePair> pairs;
  pairs.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    if (pairing.partner(i) > i) pairs.push_back({std::uint32_t(i), pairing.partner(i)});
  return pairs;
}

}  // namespace nook
