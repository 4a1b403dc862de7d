#pragma once

#include <cstdint>

#include "base/large_vector.hpp"
#include "base/task_pool.hpp"
#include "bvh/box4.hpp"
#include "bvh/triangle_pairs.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A pair of triangles, or one, while it is sorted into the tree.
struct Reference {
  float lo[3];
  std::uint32_t first;  // TrianglePair
  float hi[3];
  std::uint32_t second;

  Float4 low() const { return load4(lo); }  // the fourth lane is no number
  Float4 high() const { return load4(hi); }
  /// Twice the box's centre: the half cancels wherever it is compared. Its fourth lane is 0, for arithmetic
  /// on an index's bits, a denormal number, is slow.
  Float4 center() const { return Float4{lo[0], lo[1], lo[2], 0} + Float4{hi[0], hi[1], hi[2], 0}; }
};

/// What a set of references spans.
struct Span4 {
  Box4 box = Box4::empty();      ///< of the pairs
  Box4 centers = Box4::empty();  ///< of Reference::center()

  void add(const Reference& r) {
    box.add(r.low(), r.high());
    const Float4 c = r.center();
    centers.add(c, c);
  }
  void add(const Span4& s) {
    box.add(s.box);
    centers.add(s.centers);
  }
};

/// pair_triangles(), with boxes.
struct References {
  LargeVector<Reference> values;
  Span4 span;
};

References make_references(const TriangleMesh& mesh, TaskPool& pool);

}  // namespace nook
