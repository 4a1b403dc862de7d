#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace nook::meshgen {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

/// A piece of surface: indexed triangles, counter-clockwise seen from outside.
/// `triangle_normals` is empty until shaded() has been called.
struct Part {
  std::vector<dvec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<dvec3> normals;
  std::vector<std::array<std::uint32_t, 3>> triangle_normals;

  std::uint32_t add(const dvec3& p) {
    positions.push_back(p);
    return std::uint32_t(positions.size() - 1);
  }
  /// A triangle; one that repeats a vertex (a pole of a grid) is left out.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  }
  /// Two triangles, split along the shorter diagonal.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
};

/// Vertex normals: at each corner the mean, weighted by angle, of the faces around the vertex that lie within
/// `crease` degrees of the corner's own face (Thuermer and Wuethrich 1998).
Part shaded(Part part, double crease = 35);

/// The part under an affine map; a mirroring one also turns the winding.
Part transformed(const Part& part, const dmat4& m);

void append(Part& to, const Part& from);

/// A mesh file to be: groups in the order of their names' first use, each with a material.
class Model {
 public:
  struct Group {
    std::string name, material;
    Part part;
  };

  /// Appends the part to the group; shades it first (crease 35 degrees) if it has no normals.
  void add(const std::string& group, const std::string& material, const Part& part,
           const dmat4& m = dmat4(1));
  /// Phong exponent of a material; negative: it has no lobe, and the MTL no Ns.
  void material(const std::string& name, double exponent) { exponents_[name] = exponent; }
  /// Coordinates far from 1: they are written as the shortest decimals of their floats instead of with six
  /// decimals.
  bool exact = false;
  /// Moves the whole model.
  void transform(const dmat4& m);

  const std::vector<Group>& groups() const { return groups_; }
  const std::map<std::string, double>& exponents() const { return exponents_; }
  std::size_t triangle_count() const;

 private:
  std::vector<Group> groups_;
  std::map<std::string, double> exponents_;
};

}  // namespace nook::meshgen
