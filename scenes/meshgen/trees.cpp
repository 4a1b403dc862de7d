// Trees for a forest: light meshes of thin leaves, to be placed many times.
#include <cmath>

#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

/// A direction at `polar` degrees from `axis`, `around` degrees about it.
dvec3 leaning(const dvec3& axis, double polar, double around) {
  const dmat4 f = frame({0, 0, 0}, axis, std::abs(axis.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1));
  const double p = polar * pi / 180, a = around * pi / 180;
  return glm::normalize(
      dvec3(f * glm::dvec4(std::sin(p) * std::cos(a), std::cos(p), std::sin(p) * std::sin(a), 0)));
}

/// A branch from `base` along `direction`, sagging or rising by `bend` at its end.
std::vector<dvec3> branch(const dvec3& base, const dvec3& direction, double length, double bend, int points) {
  std::vector<dvec3> path;
  for (int i = 0; i < points; ++i) {
    const double t = double(i) / (points - 1);
    path.push_back(base + length * t * direction + dvec3(0, bend * t * t, 0));
  }
  return path;
}

std::vector<double> tapered(double from, double to, std::size_t points) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < points; ++i)
    radii.push_back(from + (to - from) * double(i) / double(points - 1));
  return radii;
}

/// A leaf of four triangles, folded along its midrib, as a sheet.
void add_leaf(Part& part, const dvec3& stalk, const dvec3& along, const dvec3& up, double length,
              double width) {
  const dvec3 across = glm::normalize(glm::cross(along, up)), lift = glm::cross(across, along);
  const std::uint32_t base = part.add(stalk), tip = part.add(stalk + length * along),
                      middle = part.add(stalk + 0.5 * length * along - 0.12 * width * lift),
                      left = part.add(stalk + 0.45 * length * along - 0.5 * width * across),
                      right = part.add(stalk + 0.45 * length * along + 0.5 * width * across);
  part.triangle(base, middle, left);
  part.triangle(middle, tip, left);
  part.triangle(base, right, middle);
  part.triangle(middle, right, tip);
}

}  // namespace

Model oak() {
  Model model;
  model.material("bark", -1);
  model.material("leaf", 12);
  const std::vector<dvec3> trunk = {
      {0, -0.05, 0}, {0.03, 0.5, 0.02}, {-0.02, 1.0, 0.05}, {0.04, 1.5, 0}, {0, 2.1, 0.03}};
  model.add("trunk", "bark", tube(spline(trunk, 3), tapered(0.13, 0.04, 13), 9));
  Part wood, leaves;
  std::uint32_t id = 0;
  for (int b = 0; b < 11; ++b) {
    const double height = 0.75 + 1.25 * b / 10, reach = 1.05 - 0.5 * std::abs(height - 1.25);
    const dvec3 base(0.01 * std::sin(3.0 * b), height, 0.02),
        direction = leaning({0, 1, 0}, 62 - 35.0 * b / 10, 137.5 * b);
    const auto main = branch(base, direction, reach, 0.2, 5);
    append(wood, tube(main, tapered(0.045, 0.012, 5), 6));
    for (int t = 0; t < 6; ++t) {
      const dvec3 from = main[std::size_t(1 + (t + 1) / 2)];
      const auto twig =
          branch(from, leaning(direction, 25 + 40 * hash01(id, 1), 60.0 * t + 90 * hash01(id, 2)),
                 0.35 + 0.2 * hash01(id, 3), 0.05, 4);
      append(wood, tube(twig, tapered(0.011, 0.004, 4), 4));
      for (int l = 0; l < 56; ++l, ++id) {
        const dvec3 at = glm::mix(twig[1], twig[3], hash01(id, 4)) +
                         0.16 * hash01(id, 5) * leaning({0, 1, 0}, 180 * hash01(id, 6), 360 * hash01(id, 7));
        add_leaf(leaves, at,
                 leaning(glm::normalize(at - dvec3(0, 1.1, 0)), 70 * hash01(id, 8), 360 * hash01(id, 9)),
                 leaning({0, 1, 0}, 50 * hash01(id, 10), 360 * hash01(id, 11)), 0.09 + 0.04 * hash01(id, 12),
                 0.05);
      }
    }
  }
  model.add("branches", "bark", wood);
  model.add("leaves", "leaf", leaves);
  return model;
}

Model fir() {
  Model model;
  model.material("bark", -1);
  model.material("needles", 12);
  model.add("trunk", "bark",
            tube({{0, -0.05, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3.1, 0}}, {0.10, 0.07, 0.04, 0.006}, 8));
  Part wood, needles;
  std::uint32_t id = 0;
  constexpr int whorls = 17;
  for (int w = 0; w < whorls; ++w) {
    const double rise = double(w) / (whorls - 1), height = 0.35 + 2.6 * rise,
                 reach = 0.95 * (1 - rise) + 0.08;
    for (int b = 0; b < 8; ++b, ++id) {
      const dvec3 direction = leaning({0, 1, 0}, 96 - 30 * rise, 45.0 * b + 22.5 * w + 14 * hash01(id, 1));
      const auto bough =
          branch({0, height, 0}, direction, reach * (0.85 + 0.3 * hash01(id, 2)), -0.12 * (1 - rise), 6);
      append(wood, tube(bough, tapered(0.016 * (1 - rise) + 0.005, 0.003, 6), 4));
      const int sprays = 8 + int(10 * (1 - rise));
      for (int s = 0; s < sprays; ++s)
        for (const double side : {-1.0, 1.0}) {
          const double t = (s + 0.7) / (sprays + 0.4) * 4.999;
          const auto i = std::size_t(t);
          const dvec3 at = glm::mix(bough[i], bough[i + 1], t - double(i));
          const dvec3 across = glm::normalize(glm::cross(direction, dvec3(0, 1, 0)));
          const std::uint32_t key = 64 * id + std::uint32_t(2 * s) + (side > 0);
          add_leaf(needles, at,
                   glm::normalize(0.8 * direction + side * across - dvec3(0, 0.25 + 0.2 * hash01(key, 3), 0)),
                   leaning({0, 1, 0}, 25 * hash01(key, 4), 360 * hash01(key, 5)),
                   0.17 * (1 - 0.55 * t / 5) * (1.1 - 0.6 * rise), 0.05);
        }
    }
  }
  model.add("boughs", "bark", wood);
  model.add("needles", "needles", needles);
  return model;
}

}  // namespace nook::meshgen
