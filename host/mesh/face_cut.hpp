#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.hpp"
#include "mesh/ear_clip.hpp"

namespace nook {

/// Cuts faces into triangles that cover exactly what their outline encloses, in the face's own plane: of n
/// corners n - 2 triangles, wound as the face is, none of which has a corner that is not the face's.
///
/// The plane's normal is the sum of the cross products of neighbouring corners (Newell; Sutherland, Sproull
/// and Schumacker 1974), so that a face need not be quite flat. The corners are seen along the axis that is
/// nearest to it: that takes no arithmetic, and which side of a line a corner is on is decided exactly
/// (orientation.hpp), whatever the place and the unit. A face that is far from flat may cross itself when
/// seen along the axis; it is then seen along the normal.
///
/// Of a quad's two diagonals the shorter is taken if both lie inside; of more corners a fan from the first,
/// if that lies inside; else ears are clipped (ear_clip.hpp). Holes are part of an outline that goes to them
/// and back along the same edge, as programs write faces with windows.
class FaceCutter {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices into the face's corners

  /// Appends the triangles of a face of at least 3 corners, all finite, to `triangles`. False: the outline
  /// crosses itself, and they cover something that has its corners.
  bool cut(std::span<const dvec3> corners, std::vector<Triangle>& triangles);

 private:
  bool cut_quad(std::span<const dvec3> corners, std::vector<Triangle>& triangles);
  bool fan_covers() const;

  std::vector<dvec2> seen_;  // corners in a plane, counter-clockwise
  EarClipper clipper_;
};

}  // namespace nook
