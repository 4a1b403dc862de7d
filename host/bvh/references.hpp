#pragma once

#include <cstdint>

#include "base/large_vector.hpp"
#include "bvh/box4.hpp"
#include "bvh/task_pool.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A triangle while it is sorted into the tree.
struct Reference {
  float lo[3];
  std::uint32_t triangle;  // of the mesh
  float hi[3];
  std::uint32_t unused;

  Float4 low() const { return load4(lo); }  // the fourth lane is no number
  Float4 high() const { return load4(hi); }
  /// Twice the box's centre: the half cancels wherever it is compared.
  Float4 center() const { return Float4{lo[0], lo[1], lo[2], 0} + high(); }
};

/// What a set of references spans.
struct Span4 {
  Box4 box = Box4::empty();      ///< of the triangles
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

/// The triangles that a ray can hit, in the mesh's order.
struct References {
  LargeVector<Reference> values;
  Span4 span;
};

References make_references(const TriangleMesh& mesh, TaskPool& pool);

}  // namespace nook
