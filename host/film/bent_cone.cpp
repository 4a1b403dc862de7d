#include "film/bent_cone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook {

BentCone bent_cone(const Film& film, std::size_t pixel) {
  const auto plane = [&](std::size_t axis) { return double(std::int64_t(film.extra[axis][pixel])); };
  const dvec3 sum(plane(0), plane(1), plane(2));
  const double length = glm::length(sum), weight = double(film.sum[pixel]);
  if (!(length > 0 && weight > 0)) return {};
  const auto law = film.settings.find("weight");
  if (law != film.settings.end() && law->second == "uniform") {
    const double c = std::clamp(2 * length / weight - 1, 0.0, 1.0);
    return {vec3(sum / length), float(std::acos(c) * 180 / std::numbers::pi)};
  }
  // c² + (1 - s) c + (1 - s) = 0 with s = 3/2 |B|; e = s - 1 is 0 for a hemisphere and 1/2 for one direction.
  const double e = std::clamp(1.5 * length / weight - 1, 0.0, 0.5);
  const double c = std::min(1.0, (e + std::sqrt(e * e + 4 * e)) / 2);
  return {vec3(sum / length), float(std::acos(c) * 180 / std::numbers::pi)};
}

}  // namespace nook
