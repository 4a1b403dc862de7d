#include "primitives.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace nook::meshgen {

dmat4 translate(const dvec3& t) {
  return glm::translate(dmat4(1), t);
}
dmat4 rotate(double degrees, const dvec3& axis) {
  return glm::rotate(dmat4(1), glm::radians(degrees), axis);
}
dmat4 scale(const dvec3& s) {
  return glm::scale(dmat4(1), s);
}

dmat4 frame(const dvec3& origin, const dvec3& up, const dvec3& forward) {
  const dvec3 y = glm::normalize(up);
  dvec3 x = forward - y * glm::dot(y, forward);
  if (glm::length(x) < 1e-9) x = glm::cross(y, std::abs(y.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1));
  x = glm::normalize(x);
  const dvec3 z = glm::cross(x, y);
  return dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1));
}

Part grid(int rows, int columns, const std::function<dvec3(int, int)>& point, GridOptions options) {
  // Points of a row that fall together become one vertex: else a pole would be a fan of triangles without
  // area.
  constexpr double together = 5e-7;
  Part part;
  std::vector<std::uint32_t> index(std::size_t(rows) * std::size_t(columns));
  for (int r = 0; r < rows; ++r) {
    std::uint32_t* row = index.data() + r * columns;
    for (int c = 0; c < columns; ++c) {
      const dvec3 p = point(r, c);
      const auto same = [&](int other) { return glm::distance(part.positions[row[other]], p) < together; };
      if (c > 0 && same(c - 1))
        row[c] = row[c - 1];
      else if (c > 0 && options.wrap && c + 1 == columns && same(0))
        row[c] = row[0];
      else
        row[c] = part.add(p);
    }
  }
  const int last_row = options.wrap_rows ? rows : rows - 1,
            last_column = options.wrap ? columns : columns - 1;
  for (int r = 0; r < last_row; ++r)
    for (int c = 0; c < last_column; ++c) {
      const auto at = [&](int i, int j) { return index[std::size_t((i % rows) * columns + j % columns)]; };
      part.quad(at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c));
    }
  return part;
}

Part box(const dvec3& half) {
  Part part;
  for (int i = 0; i < 8; ++i) part.add(half * dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  part.quad(0, 4, 6, 2);
  part.quad(1, 3, 7, 5);
  part.quad(0, 1, 5, 4);
  part.quad(2, 6, 7, 3);
  part.quad(0, 2, 3, 1);
  part.quad(4, 5, 7, 6);
  return part;
}

Part rounded_box(const dvec3& half, double radius, int steps) {
  // A sphere of the radius, cut at its octants and pulled apart to the corners of the inner box; poles fill
  // bottom and top.
  const dvec3 inner = half - dvec3(radius);
  const int side = steps + 1;
  const auto angle = [&](int k) { return 0.5 * pi * (k % side) / steps; };
  return grid(2 * side + 2, 4 * side,
              [&](int row, int column) {
                if (row == 0 || row == 2 * side + 1) return dvec3(0, row == 0 ? -half.y : half.y, 0);
                const bool upper = row > side;
                const double latitude = angle(row - 1) - (upper ? 0 : 0.5 * pi);
                const int quadrant = column / side;
                const double longitude = angle(column) + 0.5 * pi * quadrant;
                const dvec3 corner(quadrant == 0 || quadrant == 3 ? 1 : -1, upper ? 1 : -1,
                                   quadrant < 2 ? -1 : 1);
                const dvec3 n(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                              -std::cos(latitude) * std::sin(longitude));
                return corner * inner + radius * n;
              },
              {.wrap = true});
}

Part lathe(const std::vector<dvec2>& profile, int segments) {
  return grid(int(profile.size()), segments,
              [&](int row, int column) {
                const double a = -2 * pi * column / segments;
                const dvec2 p = profile[std::size_t(row)];
                return dvec3(p.x * std::cos(a), p.y, p.x * std::sin(a));
              },
              {.wrap = true});
}

Part cylinder(double radius, double height, int segments, double bevel) {
  if (bevel <= 0) return lathe({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, segments);
  return lathe({{0, 0},
                {radius - bevel, 0},
                {radius, bevel},
                {radius, height - bevel},
                {radius - bevel, height},
                {0, height}},
               segments);
}

Part sphere(double radius, int segments, int rings) {
  std::vector<dvec2> profile;
  for (int i = 0; i <= rings; ++i) {
    const double a = pi * i / rings;
    profile.emplace_back(i == 0 || i == rings ? 0.0 : radius * std::sin(a), -radius * std::cos(a));
  }
  return lathe(profile, segments);
}

Part torus(double major, double minor, int segments, int sides) {
  return grid(sides, segments,
              [&](int row, int column) {
                const double a = -2 * pi * column / segments, b = 2 * pi * row / sides;
                const double r = major + minor * std::cos(b);
                return dvec3(r * std::cos(a), minor * std::sin(b), r * std::sin(a));
              },
              {.wrap = true, .wrap_rows = true});
}

Part extrude(const std::vector<dvec2>& outline, double height, double bevel) {
  dvec2 mean(0);
  for (const dvec2& p : outline) mean += p / double(outline.size());
  const auto inset = [&](const dvec2& p) { return p - bevel * glm::normalize(p - mean); };
  const int rows = bevel > 0 ? 5 : 4;
  return grid(rows, int(outline.size()),
              [&](int row, int column) {
                const dvec2 p = outline[std::size_t(column)];
                if (row == 0) return dvec3(mean.x, 0, mean.y);
                if (row == rows - 1) return dvec3(mean.x, height, mean.y);
                if (row == 3) return dvec3(inset(p).x, height, inset(p).y);
                return dvec3(p.x, row == 1 ? 0 : height - bevel, p.y);
              },
              {.wrap = true});
}

std::vector<dvec3> spline(const std::vector<dvec3>& points, int steps) {
  std::vector<dvec3> out;
  const int count = int(points.size());
  const auto at = [&](int i) { return points[std::size_t(std::clamp(i, 0, count - 1))]; };
  for (int i = 0; i + 1 < count; ++i)
    for (int k = 0; k < steps; ++k) {
      const double t = double(k) / steps;
      const dvec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
      out.push_back(
          0.5 *
          (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))));
    }
  out.push_back(points.back());
  return out;
}

Part tube(const std::vector<dvec3>& path, double radius, int sides) {
  return tube(path, std::vector<double>(path.size(), radius), sides);
}

Part tube(const std::vector<dvec3>& path, const std::vector<double>& radii, int sides) {
  const int count = int(path.size());
  std::vector<dmat4> frames;
  dvec3 x(0);
  for (int i = 0; i < count; ++i) {
    const dvec3 tangent =
        path[std::size_t(std::min(i + 1, count - 1))] - path[std::size_t(std::max(i - 1, 0))];
    frames.push_back(frame(path[std::size_t(i)], tangent, x));
    x = dvec3(frames.back()[0]);
  }
  return grid(count + 2, sides,
              [&](int row, int column) {
                const int i = std::clamp(row - 1, 0, count - 1);
                const double r = row == 0 || row == count + 1 ? 0 : radii[std::size_t(i)];
                const double a = -2 * pi * column / sides;
                return dvec3(frames[std::size_t(i)] * glm::dvec4(r * std::cos(a), 0, r * std::sin(a), 1));
              },
              {.wrap = true});
}

double hash01(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca77u;
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return (h ^ (h >> 16)) * 0x1p-32;
}

}  // namespace nook::meshgen
