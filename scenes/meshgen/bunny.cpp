#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

/// Positions and faces of an OBJ file of triangles; all else in it is passed over.
Part read_triangles(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  Part part;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "v") {
      dvec3 p;
      if (!(words >> p.x >> p.y >> p.z)) throw std::runtime_error("bad vertex in " + file.string());
      part.add(p);
    } else if (keyword == "f") {
      std::uint32_t index[3];
      for (std::uint32_t& i : index) {
        std::string corner;
        if (!(words >> corner)) throw std::runtime_error("bad face in " + file.string());
        i = std::uint32_t(std::stoul(corner)) - 1;
        if (i >= part.positions.size()) throw std::runtime_error("face out of range in " + file.string());
      }
      part.triangle(index[0], index[1], index[2]);
    }
  }
  if (part.triangles.empty()) throw std::runtime_error("no triangles in " + file.string());
  return part;
}

}  // namespace

Model bunny_on_plane(const std::filesystem::path& file) {
  const Part rabbit = read_triangles(file);
  dvec3 lo = rabbit.positions.front(), hi = lo;
  for (const dvec3& p : rabbit.positions) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
  const double height = hi.y - lo.y;
  const dvec3 foot(0.5 * (lo.x + hi.x), lo.y, 0.5 * (lo.z + hi.z));

  Model model;
  model.material("bunny", 100);
  model.material("ground", -1);
  // Two units high, sunk by half a per cent so that it stands.
  model.add("bunny", "bunny", shaded(rabbit, 180),
            translate({0, -0.01, 0}) * scale(dvec3(2 / height)) * translate(-foot));
  Part plane;
  for (const dvec3& p : {dvec3(-10, 0, 10), dvec3(10, 0, 10), dvec3(10, 0, -10), dvec3(-10, 0, -10)})
    plane.add(p);
  plane.quad(0, 1, 2, 3);
  model.add("plane", "ground", plane);
  return model;
}

}  // namespace nook::meshgen
