#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "plan/coarse_triangle.hpp"

namespace nook {

/// What one look at every triangle tells.
struct CoarseSurvey {
  std::vector<CoarseTriangle> coarsest;  ///< the coarsest first, at most 16
  std::optional<CoarseTriangle> largest;
  double least_extent = HUGE_VAL;
  std::uint64_t triangles = 0, narrow = 0;  ///< with an area; narrower than their resolution
  CoarsestFor narrowest, from_eye;

  void look_at(std::uint64_t number, const std::array<vec3, 3>& corners, const std::optional<dvec3>& eye);
  void add(const CoarseSurvey& other);

 private:
  void look_closer(const CoarseTriangle& t, const std::optional<dvec3>& eye);
  void keep(const CoarseTriangle& t);
  void take_larger(const CoarseTriangle& t);
};

/// Of every triangle where there are no instances; else of each mesh that is placed the coarsest, as it is
/// placed, and then none is counted as narrow.
CoarseSurvey survey_of(const TriangleMesh& mesh, const std::optional<dvec3>& eye);

/// Of the triangles below a hundredth of the largest one's extent, up to 64 spread over the mesh: if more
/// than a quarter lie within the resolution of a triangle that exceeds their own extent, the largest of these
/// extents and the triangle coarsest for it. Without instances.
CoarsestFor coarsest_for_small(const TriangleMesh& mesh, const CoarseSurvey& survey);

}  // namespace nook
