#pragma once

#include <functional>
#include <vector>

#include "part.hpp"

namespace nook::meshgen {

constexpr double pi = 3.14159265358979323846;

dmat4 translate(const dvec3& t);
/// Right-handed rotation about an axis, degrees.
dmat4 rotate(double degrees, const dvec3& axis);
dmat4 scale(const dvec3& s);
/// The frame at `origin` whose y axis is `up` and whose x axis lies closest to `forward`.
dmat4 frame(const dvec3& origin, const dvec3& up, const dvec3& forward);

/// Rows of points joined by quads; outside is where (along a row) x (row to row) points. With `wrap` the last
/// point of a row joins the first; with `wrap_rows` the last row the first. A row of equal points is a pole.
struct GridOptions {
  bool wrap = false, wrap_rows = false;
};
Part grid(int rows, int columns, const std::function<dvec3(int row, int column)>& point,
          GridOptions options = {});

/// Axis-aligned, centred, half extents `half`.
Part box(const dvec3& half);
/// A box whose edges and corners are rounded with `radius` in `steps` steps (1: chamfered).
Part rounded_box(const dvec3& half, double radius, int steps = 2);

/// Revolves (radius, y) points about the y axis; outside is to the right of the profile's direction seen with
/// radius to the right and y upwards, so a closed solid's outline runs from bottom to top.
Part lathe(const std::vector<dvec2>& profile, int segments);
/// Solid cylinder on the y axis from y=0 to `height`, with chamfers of `bevel`.
Part cylinder(double radius, double height, int segments, double bevel = 0);
Part sphere(double radius, int segments, int rings);
/// About the y axis.
Part torus(double major, double minor, int segments, int sides);

/// Outline in the xz plane (counter-clockwise seen from +y, star-shaped about its mean), from y=0 to
/// `height`, upper edge chamfered.
Part extrude(const std::vector<dvec2>& outline, double height, double bevel = 0);

/// A round rod along the points (parallel-transported frame), closed by flat ends.
Part tube(const std::vector<dvec3>& path, double radius, int sides);
/// A tube whose radius is given at each point.
Part tube(const std::vector<dvec3>& path, const std::vector<double>& radii, int sides);
/// Catmull-Rom through the points, `steps` per span.
std::vector<dvec3> spline(const std::vector<dvec3>& points, int steps);

/// The whole number hash of (a, b) as a double in [0,1): the generator's only source of variety.
double hash01(std::uint32_t a, std::uint32_t b = 0);

}  // namespace nook::meshgen
