#include "points/texture_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "points/outside.hpp"
#include "points/triangle_point.hpp"

namespace nook {
namespace {

using glm::dvec2;

constexpr double half_diagonal_squared = 0.5;  // of a texel

using Corners = std::array<dvec2, 3>;

double cross2(const dvec2& a, const dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Of a point and a triangle of the texture, in texels.
struct Nearest {
  dvec3 weights;                // barycentrics of the triangle's point that is nearest
  double distance_squared = 0;  // 0: the point lies in the triangle
  bool inside = false;          // and on none of its edges
};

Nearest nearest_on(const Corners& c, const dvec2& p) {
  const double area = cross2(c[1] - c[0], c[2] - c[0]);
  if (area != 0) {
    const dvec3 w =
        dvec3(cross2(c[1] - p, c[2] - p), cross2(c[2] - p, c[0] - p), cross2(c[0] - p, c[1] - p)) / area;
    constexpr double on_edge = 1e-9;
    if (w.x >= 0 && w.y >= 0 && w.z >= 0) return {w, 0, w.x > on_edge && w.y > on_edge && w.z > on_edge};
  }
  Nearest best{{}, INFINITY, false};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const dvec2 edge = c[std::size_t(j)] - c[std::size_t(i)], to_point = p - c[std::size_t(i)];
    const double length_squared = glm::dot(edge, edge);
    const double t = length_squared > 0 ? std::clamp(glm::dot(to_point, edge) / length_squared, 0.0, 1.0) : 0;
    const dvec2 away = to_point - t * edge;
    if (glm::dot(away, away) >= best.distance_squared) continue;
    best.distance_squared = glm::dot(away, away);
    best.weights = dvec3(0);
    best.weights[i] = 1 - t;
    best.weights[j] = t;
  }
  return best;
}

bool has_uvs(const TriangleMesh& mesh, std::size_t t) {
  const auto& corners = mesh.triangle_uvs[t];
  return std::none_of(corners.begin(), corners.end(),
                      [](std::uint32_t i) { return i == TriangleMesh::no_normal; });
}

Corners corners_in_texels(const TriangleMesh& mesh, std::size_t t, int size) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec2 uv(mesh.uvs[mesh.triangle_uvs[t][k]]);
    corners[k] = dvec2(uv.x, 1 - uv.y) * double(size);
    for (const double x : {corners[k].x, corners[k].y})
      if (!(x >= -0.5 && x <= size + 0.5))
        throw Error(ErrorKind::scene,
                    fmt::format("the texture coordinates ({:g}, {:g}) of triangle {} lie outside 0 to 1",
                                uv.x, uv.y, t + 1));
  }
  return corners;
}

// The triangle of each texel, and what was seen on the way.
struct Coverage {
  std::vector<std::uint32_t> triangle;
  std::vector<float> distance_squared;
  std::vector<bool> inside, overlapped;
};

void cover(const Corners& corners, std::uint32_t triangle, int size, Coverage& coverage) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const auto texel_at = [&](double x) { return std::clamp(int(std::floor(x)), 0, size - 1); };
  const double reach = std::sqrt(half_diagonal_squared) + 0.5;
  for (int y = texel_at(top - reach); y <= texel_at(bottom + reach); ++y)
    for (int x = texel_at(left - reach); x <= texel_at(right + reach); ++x) {
      const Nearest found = nearest_on(corners, {x + 0.5, y + 0.5});
      if (found.distance_squared > half_diagonal_squared) continue;
      const std::size_t texel = std::size_t(y) * std::size_t(size) + std::size_t(x);
      if (found.inside && coverage.inside[texel]) coverage.overlapped[texel] = true;
      if (found.inside) coverage.inside[texel] = true;
      if (coverage.triangle[texel] != no_texel &&
          !(float(found.distance_squared) < coverage.distance_squared[texel]))
        continue;
      coverage.triangle[texel] = triangle;
      coverage.distance_squared[texel] = float(found.distance_squared);
    }
}

}  // namespace

TexturePoints texture_points(const TriangleMesh& mesh, int size) {
  if (mesh.triangle_uvs.empty()) throw Error(ErrorKind::scene, "no triangle has texture coordinates (vt)");
  const std::size_t count = std::size_t(size) * std::size_t(size);
  Coverage coverage{std::vector<std::uint32_t>(count, no_texel), std::vector<float>(count),
                    std::vector<bool>(count), std::vector<bool>(count)};
  TexturePoints made;
  made.size = size;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!has_uvs(mesh, t))
      ++made.without_uv;
    else if (face_normal(mesh, t) != dvec3(0))
      cover(corners_in_texels(mesh, t, size), std::uint32_t(t), size, coverage);
  }
  made.overlapping = std::uint64_t(std::count(coverage.overlapped.begin(), coverage.overlapped.end(), true));
  std::vector<dvec3> centroids;
  for (std::size_t texel = 0; texel < count; ++texel) {
    const std::uint32_t t = coverage.triangle[texel];
    if (t == no_texel) continue;
    const dvec2 centre(double(texel % std::size_t(size)) + 0.5, double(texel / std::size_t(size)) + 0.5);
    const dvec3 weights = nearest_on(corners_in_texels(mesh, t, size), centre).weights;
    const TrianglePoint at = triangle_point(mesh, t, weights);
    made.texels.push_back(std::uint32_t(texel));
    made.positions.push_back(at.position);
    made.normals.push_back(at.normal);
    made.points.push_back(at.point);
    centroids.push_back(at.centroid);
  }
  move_outside(made.points, mesh, centroids);
  return made;
}

std::vector<std::uint32_t> dilation_sources(const std::vector<std::uint32_t>& covered, int size, int rings) {
  std::vector<std::uint32_t> source(std::size_t(size) * std::size_t(size), no_texel);
  for (const std::uint32_t texel : covered) source[texel] = texel;
  const auto distance_squared = [&](int x, int y, std::uint32_t texel) {
    const std::int64_t dx = x - std::int64_t(texel) % size, dy = y - std::int64_t(texel) / size;
    return dx * dx + dy * dy;
  };
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::uint32_t> before = source;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        std::uint32_t& here = source[std::size_t(y) * std::size_t(size) + std::size_t(x)];
        if (here != no_texel) continue;
        std::pair<std::int64_t, std::uint32_t> best{INT64_MAX, no_texel};
        for (int ny = std::max(0, y - 1); ny <= std::min(size - 1, y + 1); ++ny)
          for (int nx = std::max(0, x - 1); nx <= std::min(size - 1, x + 1); ++nx) {
            const std::uint32_t candidate = before[std::size_t(ny) * std::size_t(size) + std::size_t(nx)];
            if (candidate != no_texel) best = std::min(best, {distance_squared(x, y, candidate), candidate});
          }
        here = best.second;
      }
  }
  return source;
}

}  // namespace nook
