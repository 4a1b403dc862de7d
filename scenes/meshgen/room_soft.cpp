#include <cmath>

#include "foliage.hpp"
#include "primitives.hpp"
#include "room.hpp"

namespace nook::meshgen::room {

void add_textiles(Model& model) {
  // Curtains: folds that gather towards the rail, both sides of a cloth 4 mm thick.
  for (const bool left : {true, false}) {
    const double z0 = left ? 1.50 : -0.80, z1 = left ? 1.08 : -0.38;
    const int columns = 160, rows = 36;
    const auto fold = [&](double t, double v) {  // (x, z) of the cloth's middle
      const double phase = 2 * pi * 8 * t + 0.7 * std::sin(3 * v + 5 * t);
      const double depth = 0.028 + 0.022 * (1 - v) + 0.010 * std::sin(17 * t);
      return dvec2(-half_x + 0.10 + depth * std::sin(phase),
                   z0 + (z1 - z0) * t * (1 + 0.12 * (1 - v)) + 0.010 * std::cos(2 * phase));
    };
    const Part curtain = grid(rows, 2 * columns,
                              [&](int row, int column) {
                                const int i = column < columns ? column : 2 * columns - 1 - column;
                                const double t = double(i) / (columns - 1), v = double(row) / (rows - 1);
                                const dvec2 along = glm::normalize(fold(t + 1e-4, v) - fold(t - 1e-4, v));
                                const bool hem = row == 0 || row == rows - 1;  // where the two sides meet
                                const double side = hem ? 0 : column < columns ? 0.002 : -0.002;
                                const dvec2 p = fold(t, v) + side * dvec2(-along.y, along.x);
                                return dvec3(p.x, 0.05 + 2.20 * v, p.y);
                              },
                              {.wrap = true});
    model.add("curtains", "cloth", shaded(curtain, 80));
    for (int i = 0; i < 8; ++i)
      model.add("curtain_rings", "metal", torus(0.022, 0.0035, 32, 8),
                translate({-half_x + 0.10, 2.27, z0 + (z1 - z0) * (i + 0.5) / 8}) * rotate(90, {1, 0, 0}));
  }
  model.add("curtain_rail", "metal",
            tube({{-half_x + 0.10, 2.285, -1.0}, {-half_x + 0.10, 2.285, 1.7}}, 0.013, 24));
  for (const double z : {-1.0, 1.7})
    model.add("curtain_rail", "metal", shaded(sphere(0.032, 40, 20), 180),
              translate({-half_x + 0.10, 2.285, z}));

  // A braided rug: oval rounds of rope.
  const dmat4 at = translate({-0.95, 0.022, 0.85});
  for (int i = 0; i < 30; ++i) {
    const double rx = 0.28 + 0.029 * i, rz = 0.02 + 0.029 * i;
    const int steps = 96 + 8 * i;
    std::vector<dvec3> path;
    std::vector<double> radii;
    for (int k = 0; k <= steps; ++k) {
      const double a = 2 * pi * k / steps;
      path.emplace_back(rx * std::cos(a), 0, rz * std::sin(a));
      radii.push_back(0.0135 + 0.0022 * (k % 4 < 2 ? 1 : -1));
    }
    model.add("rug", "cloth", shaded(tube(path, radii, 6), 80), at);
  }
}

void add_plants(Model& model) {
  const auto pot = [&](const dmat4& m, double size) {
    model.add("pots", "glazed",
              vessel({{0.62, 0}, {0.66, 0.03}, {0.85, 0.85}, {0.95, 0.87}, {0.97, 1.0}}, 0.07, 80),
              m * scale(dvec3(size)));
    model.add("pots", "plaster", cylinder(0.80 * size, 0.02, 48), m * translate({0, 0.80 * size, 0}));
    for (int i = 0; i < 40; ++i) {  // gravel
      const double a = 2 * pi * hash01(std::uint32_t(i), 901),
                   r = 0.74 * size * std::sqrt(hash01(std::uint32_t(i), 902));
      model.add("gravel", "plaster", shaded(sphere(0.045 * size, 12, 6), 180),
                m * translate({r * std::cos(a), 0.80 * size + 0.03 * size, r * std::sin(a)}) *
                    scale({1, 0.7, 1.2}));
    }
  };
  // A rubber plant in the corner, a trailing one on the bookcase, a fern on the sideboard's end.
  const dmat4 corner = translate({1.95, 0.012, -2.05});
  pot(corner, 0.20);
  for (int s = 0; s < 6; ++s) {
    const std::uint32_t id = std::uint32_t(s);
    const double lean = 2 * pi * s / 6.0;
    std::vector<dvec3> points;
    for (int i = 0; i <= 6; ++i)
      points.emplace_back(0.05 * std::cos(lean) + 0.010 * i * i * std::cos(lean),
                          0.15 + (0.22 + 0.05 * hash01(id, 1)) * i,
                          0.05 * std::sin(lean) + 0.010 * i * i * std::sin(lean));
    const std::vector<dvec3> stem = spline(points, 8);
    model.add("stems", "leaf", tube(stem, 0.010, 12), corner);
    for (std::size_t i = 8; i < stem.size(); i += 2) {
      const double turn = 137.5 * double(i) + 60 * s, size = 0.24 + 0.10 * hash01(id, std::uint32_t(20 + i));
      model.add("leaves", "leaf", leaf(size, 0.42 * size, 0.35 * size),
                corner * translate(stem[i]) * rotate(turn, {0, 1, 0}) * rotate(38, {0, 0, 1}));
    }
  }
  const auto trailing = [&](const dvec3& at, int vines, double length) {
    for (int v = 0; v < vines; ++v) {
      const std::uint32_t id = std::uint32_t(500 + v);
      const double a = pi * (0.08 + 0.84 * v / (vines - 1));
      std::vector<dvec3> points = {{0, 0.10, 0},
                                   {0.08 * std::cos(a), 0.17, 0.08 * std::sin(a)},
                                   {0.20 * std::cos(a), 0.10, 0.14 + 0.06 * std::sin(a)}};
      const double drop = length * (0.5 + 0.5 * hash01(id, 1));
      for (int i = 1; i <= 6; ++i)
        points.emplace_back(0.23 * std::cos(a) + 0.03 * (hash01(id, std::uint32_t(2 + i)) - 0.5),
                            0.10 - drop * i / 6, 0.20 + 0.03 * (hash01(id, std::uint32_t(12 + i)) - 0.5));
      const std::vector<dvec3> stem = spline(points, 8);
      model.add("stems", "leaf", tube(stem, 0.004, 8), translate(at));
      for (std::size_t i = 5; i < stem.size(); i += 3) {
        const double size = 0.055 + 0.03 * hash01(id, std::uint32_t(40 + i));
        model.add("leaves", "leaf", leaf(size, 0.75 * size, 0.5 * size),
                  translate(at) * translate(stem[i]) *
                      rotate(-90 + 160 * (hash01(id, std::uint32_t(90 + i)) - 0.5), {0, 1, 0}) *
                      rotate(-15, {0, 0, 1}));
      }
    }
  };
  const dvec3 shelf_top(0.85, 2.40, -2.30);
  pot(translate(shelf_top), 0.13);
  trailing(shelf_top, 11, 1.0);
  const dmat4 fern = translate({-2.62, 0.86, -0.80});
  pot(fern, 0.10);
  for (int f = 0; f < 26; ++f) {
    const std::uint32_t id = std::uint32_t(700 + f);
    const double a = 2 * pi * f / 26 + hash01(id, 1), reach = 0.20 + 0.14 * hash01(id, 2),
                 up = 0.20 + 0.20 * hash01(id, 3);
    std::vector<dvec3> points;
    for (int i = 0; i <= 5; ++i) {
      const double t = i / 5.0;
      points.emplace_back(reach * t * std::cos(a), 0.09 + up * (1.9 * t - 1.4 * t * t),
                          reach * t * std::sin(a));
    }
    const std::vector<dvec3> rachis = spline(points, 5);
    model.add("stems", "leaf", tube(rachis, 0.002, 6), fern);
    for (std::size_t i = 4; i + 1 < rachis.size(); ++i)
      for (const double side : {75.0, -75.0}) {
        const double size = 0.075 * (1.05 - double(i) / double(rachis.size()));
        model.add("leaves", "leaf", leaf(size, 0.24 * size, 0.2 * size),
                  fern * translate(rachis[i]) * rotate(-glm::degrees(a) + side, {0, 1, 0}));
      }
  }
}

void add_fittings(Model& model) {
  // A column radiator under the window.
  for (int i = 0; i < 15; ++i) {
    const double z = -0.28 + 0.075 * i;
    for (const double x : {0.0, 0.05, 0.10})
      model.add("radiator", "metal",
                tube(spline({{-half_x + 0.07 + 0.05, 0.10, z},
                             {-half_x + 0.07 + x, 0.16, z},
                             {-half_x + 0.07 + x, 0.62, z},
                             {-half_x + 0.07 + 0.05, 0.68, z}},
                            5),
                     0.019, 16));
    for (const double y : {0.10, 0.68})
      model.add("radiator", "metal", shaded(sphere(0.036, 24, 12), 180), translate({-half_x + 0.12, y, z}));
  }
  for (const double y : {0.10, 0.68})
    model.add("radiator", "metal", tube({{-half_x + 0.12, y, -0.36}, {-half_x + 0.12, y, 0.85}}, 0.016, 20));
  model.add("radiator", "metal",
            tube(spline({{-half_x + 0.12, 0.10, 0.85},
                         {-half_x + 0.12, 0.10, 0.98},
                         {-half_x + 0.12, 0.0, 1.02},
                         {-half_x + 0.12, -0.02, 1.02}},
                        8),
                 0.011, 16));

  // Sockets with plugs, and cables that hang, coil and run along the skirting.
  for (const double x : {1.62, 2.35}) {
    const dvec3 at(x, 0.30, -half_z);
    model.add("sockets", "plaster", rounded_box({0.042, 0.042, 0.007}, 0.004, 3), translate(at));
    model.add("sockets", "plaster",
              lathe({{0, 0}, {0.021, 0}, {0.019, 0.035}, {0.008, 0.045}, {0.006, 0.06}, {0, 0.06}}, 32),
              translate(at) * rotate(90, {1, 0, 0}));
    std::vector<dvec3> path = {at + dvec3(0, 0, 0.06), at + dvec3(0, -0.03, 0.11),
                               at + dvec3(0.03, -0.18, 0.12), at + dvec3(0.06, -0.278, 0.14)};
    for (int k = 0; k < 60; ++k) {
      const double a = 0.5 * k, r = 0.11 + 0.02 * hash01(std::uint32_t(k), 77);
      path.push_back(at + dvec3(0.10 + r * std::sin(a), -0.280 + 0.00022 * k, 0.25 - r * std::cos(a)));
    }
    model.add("cables", "cloth", tube(spline(path, 5), 0.0045, 10));
  }
  // Pictures on the right part of the back wall, frames of three steps.
  for (int i = 0; i < 4; ++i) {
    const double w = 0.17 + 0.05 * (i % 2), h = 0.15 + 0.04 * ((i + 1) % 2);
    const dmat4 m = translate({1.95 + 0.52 * (i % 2), 1.45 + 0.48 * (i / 2), -half_z});
    const double inset[] = {0, 0.0, 0.006, 0.016, 0.020, 0.030, 0.034, 0.040},
                 lift[] = {0, 0.022, 0.028, 0.028, 0.022, 0.018, 0.012, 0.006};
    const Part frame_part = grid(9, 4,
                                 [&](int row, int column) {
                                   if (row == 8) return dvec3(0, 0, 0.006);
                                   const dvec2 corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
                                   return dvec3(corners[column].x * (w - inset[row]),
                                                corners[column].y * (h - inset[row]), lift[row]);
                                 },
                                 {.wrap = true});
    model.add("pictures", "wood", shaded(frame_part, 15), m);
  }
  // A wall clock.
  const dmat4 clock = translate({1.95, 2.38, -half_z}) * rotate(90, {1, 0, 0});
  model.add(
      "clock", "metal",
      lathe({{0, 0}, {0.13, 0}, {0.135, 0.03}, {0.125, 0.042}, {0.115, 0.038}, {0.11, 0.02}, {0, 0.018}}, 96),
      clock);
  for (int i = 0; i < 12; ++i)
    model.add("clock", "metal", rounded_box({0.004, 0.003, 0.010}, 0.001, 1),
              clock * rotate(30.0 * i, {0, 1, 0}) * translate({0, 0.022, 0.092}));
  model.add("clock", "metal", rounded_box({0.003, 0.002, 0.035}, 0.001, 1),
            clock * rotate(50, {0, 1, 0}) * translate({0, 0.026, 0.03}));
  model.add("clock", "metal", rounded_box({0.004, 0.002, 0.025}, 0.001, 1),
            clock * rotate(170, {0, 1, 0}) * translate({0, 0.029, 0.02}));
}

}  // namespace nook::meshgen::room
