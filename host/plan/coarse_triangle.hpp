#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "math/types.hpp"

namespace nook {

/// What an edge is met to, and what the depths of SSAO tell, as a part of a triangle's extent.
inline constexpr double edge_resolution = 1e-6;

/// The distance from a triangle that its rounding leaves good for .001 of an effect. n: its unit normal,
/// sides: of its box, far: the largest coordinates of its corners.
double resolution_of(const dvec3& n, const dvec3& sides, const dvec3& far);

/// A triangle, and how coarse floats make it. Units of the mesh in memory.
struct CoarseTriangle {
  std::uint64_t number = 0;
  std::array<dvec3, 3> corner;
  dvec3 normal{0};  ///< unit; 0: no area, and none of what follows
  double extent = 0, far = 0, width = 0, resolution = 0;

  CoarseTriangle(std::uint64_t its_number, const vec3& a, const vec3& b, const vec3& c);
  /// The same of its width.
  double width_resolution() const;
  double distance(const dvec3& p) const;
  /// Of two as coarse, the lower number comes first.
  bool coarser_than(const CoarseTriangle& other) const;
};

/// The triangle that is coarsest for a distance of interest beside it, if its resolution exceeds that: of
/// those that were added, in whatever order, the lowest of equals.
struct CoarsestFor {
  std::optional<CoarseTriangle> triangle;
  double resolution = 0, distance = 1;

  /// Above 1, or 1 without a triangle.
  double excess() const { return triangle ? resolution / distance : 1; }
  void add(const CoarseTriangle& other, double its_resolution, double at);
  void add(const CoarsestFor& other) {
    if (other.triangle) add(*other.triangle, other.resolution, other.distance);
  }
};

}  // namespace nook
