#include "points/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace nook {
namespace {

// A line of a file of points.
struct Row {
  std::vector<double> numbers;
  std::string wrong;        // the first word that is no finite number
  bool any_number = false;  // some word is, or begins with, a number
};

bool begins_as_number(const std::string& word) {
  const std::size_t digit = word.find_first_not_of("+-.");
  return digit < 3 && word[digit] >= '0' && word[digit] <= '9';
}

Row read_row(const std::string& line) {
  Row row;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t begin = line.find_first_not_of(", \t\r", at);
    if (begin == std::string::npos) break;
    at = std::min(line.find_first_of(", \t\r", begin), line.size());
    std::string word = line.substr(begin, at - begin);
    const char* first = word.data() + (word[0] == '+');
    double value = 0;
    const auto [end, code] = std::from_chars(first, word.data() + word.size(), value);
    const bool whole = code != std::errc::invalid_argument && end == word.data() + word.size();
    row.any_number = row.any_number || whole || begins_as_number(word);
    if (code == std::errc() && whole && std::isfinite(float(value)))
      row.numbers.push_back(value);
    else if (row.wrong.empty())
      row.wrong = word.substr(0, 40);
  }
  return row;
}

void store(float (&out)[3], const vec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

}  // namespace

// Scaled by the largest component first, so that neither 1e-30 nor 1e30 is lost.
vec3 unit(const dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest == 0 ? vec3(0) : vec3(glm::normalize(v / largest));
}

SurfacePoint surface_point(const vec3& position, const vec3& normal, const vec3& view, const vec3& off,
                           float extent) {
  constexpr double half_ulp = 0x1p-24;
  double distance = 16 * half_ulp * double(extent);
  for (int i = 0; i < 3; ++i) distance += 4 * half_ulp * std::abs(double(off[i]) * double(position[i]));
  vec3 origin;
  for (int i = 0; i < 3; ++i) {
    const float moved = float(double(position[i]) + distance * double(off[i]));
    origin[i] = off[i] == 0 ? moved : std::nextafter(moved, off[i] > 0 ? HUGE_VALF : -HUGE_VALF);
  }
  SurfacePoint point{};
  store(point.origin, origin);
  point.distance = float(glm::dot(dvec3(origin) - dvec3(position), dvec3(normal)));
  point.flags = SURFACE_HIT | SURFACE_GIVEN;
  store(point.normal, normal);
  store(point.geometric_normal, off);
  store(point.view, view);
  point.triangle = point.material = 0xffffffffu;
  return point;
}

SurfacePoint surface_point(const vec3& position, const vec3& normal, const vec3& view) {
  return surface_point(position, normal, view, normal, 0);
}

std::vector<SurfacePoint> read_points(std::istream& in, const std::string& name, bool needs_view,
                                      const Frame& frame) {
  std::vector<SurfacePoint> points;
  std::string line;
  bool first = true;
  for (std::size_t row = 1; std::getline(in, line); ++row) {
    if (row == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (line.find_first_not_of(", \t\r") == std::string::npos || line[0] == '#') continue;
    const auto [n, wrong, any_number] = read_row(line);
    const bool header = first && !any_number;
    first = false;
    if (header) continue;
    auto fail = [&name, row](const std::string& what) {
      throw Error(ErrorKind::scene, Place{name, row}, what);
    };
    if (!wrong.empty()) fail(fmt::format("'{}' is not a finite number", wrong));
    if (n.size() != 6 && n.size() != 9)
      fail(fmt::format("{} columns, expected px,py,pz,nx,ny,nz or px,py,pz,nx,ny,nz,vx,vy,vz", n.size()));
    const vec3 normal = unit({n[3], n[4], n[5]});
    const vec3 view = n.size() == 9 ? unit({n[6], n[7], n[8]}) : vec3(0);
    if (normal == vec3(0)) fail("the normal is zero");
    if (needs_view && view == vec3(0))
      fail(n.size() == 9 ? "the view direction is zero"
                         : "RO needs the view direction: px,py,pz,nx,ny,nz,vx,vy,vz");
    points.push_back(surface_point(vec3(frame.from_file(dvec3(n[0], n[1], n[2]))), normal, view));
  }
  if (points.empty()) throw Error(ErrorKind::scene, Place{name}, "there are no points");
  return points;
}

std::vector<SurfacePoint> load_points(const std::filesystem::path& path, bool needs_view,
                                      const Frame& frame) {
  size_of_input(path);
  std::ifstream in(path);
  if (!in) throw Error(ErrorKind::scene, Place{path.string()}, "cannot be read");
  return read_points(in, path.string(), needs_view, frame);
}

}  // namespace nook
