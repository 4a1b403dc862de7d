#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/instance.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// The vertices of a mesh's triangles, less those of a ground that was added, for questions about the
/// farthest of them: most are answered by boxes about many. `mesh` must outlive it.
class SubjectPoints {
 public:
  explicit SubjectPoints(const TriangleMesh& mesh);

  struct Farthest {
    double value = -std::numeric_limits<double>::infinity();
    dvec3 point{0};
  };
  /// Where a convex function of a point (double(const dvec3&)) is largest.
  template <class Function>
  Farthest farthest(const Function& f) const {
    Farthest best;
    for (const Group& group : groups_)
      for (std::size_t b = group.first; b < group.end; ++b) {
        const Block& block = blocks_[b];
        if (!(most_in(block.bounds, group.place, f) > best.value)) continue;
        for (std::uint32_t t = block.first; t < block.end; ++t)
          for (const std::uint32_t i : mesh_.triangles[t]) {
            const dvec3 p = placed(group.place, mesh_.positions[i]);
            if (const double value = f(p); value > best.value) best = {value, p};
          }
      }
    // A mesh without triangles has its bounds.
    const Bounds3& b = mesh_.subject_bounds();
    for (int corner = 0; blocks_.empty() && corner < 8; ++corner)
      if (const double value = f(corner_of(b, corner)); value > best.value)
        best = {value, corner_of(b, corner)};
    return best;
  }

 private:
  struct Block {
    std::uint32_t first = 0, end = 0;  // triangles
    Bounds3 bounds;
  };
  // Blocks of a mesh that is placed; all of one that is not.
  struct Group {
    std::size_t first, end;
    const PlacedMesh* place;
  };

  static dvec3 placed(const PlacedMesh* place, const vec3& p) {
    return dvec3(place ? placed_position(*place, p) : p);
  }
  static vec3 corner_of(const Bounds3& b, int corner) {
    return {corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z};
  }
  template <class Function>
  static double most_in(const Bounds3& b, const PlacedMesh* place, const Function& f) {
    double most = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) most = std::max(most, f(placed(place, corner_of(b, corner))));
    return most;
  }
  void add_blocks(std::uint32_t first, std::uint32_t count);

  const TriangleMesh& mesh_;
  std::vector<Block> blocks_;
  std::vector<Group> groups_;
};

}  // namespace nook
