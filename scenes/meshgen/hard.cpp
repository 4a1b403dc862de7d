#include <cmath>

#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

Part rectangle(const dvec3& corner, const dvec3& along, const dvec3& across) {
  Part part;
  part.add(corner);
  part.add(corner + along);
  part.add(corner + along + across);
  part.add(corner + across);
  part.quad(0, 1, 2, 3);
  return shaded(part);
}

}  // namespace

Model hard_contact(double factor, const dvec3& offset) {
  Model model;
  model.exact = true;
  model.material("matt", -1);
  model.add("floor", "matt", rectangle({-40, 0, 40}, {80, 0, 0}, {0, 0, -80}));
  model.add("sphere", "matt", shaded(sphere(1, 256, 128), 180), translate({0, 1, 0}));
  model.transform(translate(offset) * scale(dvec3(factor)));
  return model;
}

Model hard_wedge() {
  Model model;
  model.exact = true;
  model.material("matt", -1);
  // The edge is the z axis; the plates reach 1000 units from it, and the camera looks at the first unit.
  const double angle = glm::radians(10.0), reach = 1000;
  model.add("floor", "matt", rectangle({0, 0, reach}, {reach, 0, 0}, {0, 0, -2 * reach}));
  model.add(
      "lid", "matt",
      rectangle({0, 0, -reach}, {reach * std::cos(angle), reach * std::sin(angle), 0}, {0, 0, 2 * reach}));
  return model;
}

Model hard_spikes() {
  Model model;
  model.exact = true;
  model.material("matt", -1);
  const int rows = 97, columns = 192;
  Part star = grid(
      rows, columns,
      [&](int r, int c) {
        const double latitude = pi * (double(r) / (rows - 1) - 0.5), longitude = -2 * pi * c / columns;
        const bool pole = r == 0 || r == rows - 1;
        const double radius =
            pole || (r + c) % 2 ? 1.0 : 1.5 + 2.5 * hash01(std::uint32_t(r), std::uint32_t(c));
        const double ring = pole ? 0 : std::cos(latitude);
        return radius * dvec3(ring * std::cos(longitude), std::sin(latitude), ring * std::sin(longitude));
      },
      {.wrap = true});
  for (auto& t : star.triangles) std::swap(t[1], t[2]);
  model.add("star", "matt", shaded(star, 1));
  return model;
}

Model hard_slivers() {
  Model model;
  model.exact = true;
  model.material("matt", -1);
  Part floor;
  // Strips of falling width: from 1 down to 2e-6 wide, 20 long, each cut along its diagonal.
  double z = 2;
  for (int i = 0; i < 600; ++i) {
    const double width = i < 24 ? std::pow(10.0, -0.25 * i) : 0.5e-2 * (1 + hash01(std::uint32_t(i), 1));
    const std::uint32_t first = floor.add({-10, 0, z});
    floor.add({10, 0, z});
    floor.add({10, 0, z - width});
    floor.add({-10, 0, z - width});
    floor.triangle(first, first + 1, first + 2);
    floor.triangle(first, first + 2, first + 3);
    if (i % 3 == 0) floor.triangle(first, first + 1, first + 2);  // once more
    const std::uint32_t middle = floor.add({0, 0, z});
    if (i % 5 == 0) floor.triangle(first, middle, first + 1);  // no area
    z -= width;
  }
  model.add("floor", "matt", shaded(floor));
  return model;
}

}  // namespace nook::meshgen
