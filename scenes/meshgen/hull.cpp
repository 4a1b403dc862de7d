#include "hull.hpp"

#include <algorithm>
#include <cmath>

#include "primitives.hpp"

namespace nook::meshgen {
namespace {

/// A line of the skin's grid; those of a seam come as four: two edges at the surface, two at the groove's
/// floor.
struct Line {
  double at;
  int seam;    // index, or -1
  bool floor;  // at the bottom of the groove
};

std::vector<Line> grid_lines(const std::vector<double>& seams, double half_width, int plain, double from,
                             double to) {
  std::vector<Line> lines;
  for (int i = 0; i <= plain; ++i) {
    const double t = from + (to - from) * i / plain;
    const bool near =
        std::any_of(seams.begin(), seams.end(), [&](double s) { return std::abs(s - t) < 1.5 * half_width; });
    if (!near) lines.push_back({t, -1, false});
  }
  for (int k = 0; k < int(seams.size()); ++k)
    for (const double offset : {-1.0, -0.6, 0.6, 1.0})
      lines.push_back({seams[std::size_t(k)] + offset * half_width, k, std::abs(offset) < 1});
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.at < b.at; });
  return lines;
}

double power_of(double x, double exponent) {
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

/// Cubic Hermite interpolation with slopes by finite differences: no overshoot worth speaking of at our
/// spacing.
double interpolate(const std::vector<HullSection>& sections, double HullSection::*value, double x) {
  const int count = int(sections.size());
  int i = 0;
  while (i + 2 < count && sections[std::size_t(i + 1)].x > x) ++i;
  const auto at = [&](int k) -> const HullSection& {
    return sections[std::size_t(std::clamp(k, 0, count - 1))];
  };
  const auto slope = [&](int k) {
    const HullSection &a = at(k - 1), &b = at(k + 1);
    return (b.*value - a.*value) / (b.x - a.x);
  };
  const double h = at(i + 1).x - at(i).x, t = (x - at(i).x) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * (at(i).*value) + (t3 - 2 * t2 + t) * h * slope(i) +
         (3 * t2 - 2 * t3) * (at(i + 1).*value) + (t3 - t2) * h * slope(i + 1);
}

}  // namespace

HullSection Hull::section(double s) const {
  HullSection out{};
  out.x = sections_.front().x + s * (sections_.back().x - sections_.front().x);
  for (double HullSection::*value :
       {&HullSection::y, &HullSection::width, &HullSection::top, &HullSection::bottom, &HullSection::power})
    out.*value = interpolate(sections_, value, out.x);
  return out;
}

dvec3 Hull::point(double s, double a) const {
  const HullSection h = section(s);
  const double sine = std::sin(2 * pi * a), cosine = -std::cos(2 * pi * a);
  return {h.x, h.y + (cosine > 0 ? h.top : h.bottom) * power_of(cosine, 2 / h.power),
          h.width * power_of(sine, 2 / h.power)};
}

dvec3 Hull::normal(double s, double a) const {
  const double e = 2e-4;
  const double s0 = std::max(0.0, s - e), s1 = std::min(1.0, s + e);
  const dvec3 n = glm::cross(point(s, a + 10 * e) - point(s, a - 10 * e), point(s1, a) - point(s0, a));
  return glm::normalize(n);
}

dmat4 Hull::mount(double s, double a, double height) const {
  const dvec3 n = normal(s, a);
  return frame(point(s, a) + height * n, n, {1, 0, 0});
}

Part Hull::skin(const Panels& panels) const {
  const double length = sections_.front().x - sections_.back().x;
  std::vector<double> stringers = panels.stringers;
  for (auto it = panels.stringers.rbegin(); it != panels.stringers.rend(); ++it) stringers.push_back(1 - *it);
  const int strips = int(stringers.size());
  const std::vector<Line> rows = grid_lines(panels.stations, 0.5 * panels.width / length, 150, 0, 1);
  const std::vector<Line> columns = grid_lines(stringers, 0.5 * panels.width / 2.2, 120, 0, 1 - 1.0 / 120);

  const auto mirrored = [&](int strip) { return std::min(strip, strips - strip); };
  const auto strip_of = [&](double a) {
    return int(std::upper_bound(stringers.begin(), stringers.end(), a) - stringers.begin());
  };
  const auto has_seam = [&](int strip, int station) {
    return hash01(std::uint32_t(mirrored(strip)), std::uint32_t(station)) < panels.used;
  };
  const auto depth_at = [&](const Line& row, const Line& column) {
    const int strip = strip_of(column.at);
    if (row.floor && has_seam(strip, row.seam)) return -panels.depth;
    const bool merged = column.seam >= 0 && std::min(column.seam, strips - 1 - column.seam) % 2 == 0;
    if (column.floor && (row.at >= panels.merged_before || !merged)) return -panels.depth;
    if (row.at < panels.merged_before) return 0.0;
    int panel = 0;
    for (int k = 0; k < int(panels.stations.size()); ++k)
      if (panels.stations[std::size_t(k)] < row.at && has_seam(strip, k)) panel = k + 1;
    const double draw = hash01(std::uint32_t(100 + mirrored(strip)), std::uint32_t(panel));
    return draw < 0.22 ? panels.step : draw > 0.84 ? -panels.step : 0.0;
  };
  // Two more rows close the ends with poles.
  const int count = int(rows.size());
  Part part =
      grid(count + 2, int(columns.size()),
           [&](int r, int c) {
             const Line& row = rows[std::size_t(std::clamp(r - 1, 0, count - 1))];
             if (r == 0 || r == count + 1) {
               const HullSection end = section(row.at);
               return dvec3(end.x, end.y, 0);
             }
             const Line& column = columns[std::size_t(c)];
             const double room = std::min(1.0, section(row.at).width / 0.15);
             return point(row.at, column.at) + depth_at(row, column) * room * normal(row.at, column.at);
           },
           {.wrap = true});
  return shaded(part, 35);
}

}  // namespace nook::meshgen
