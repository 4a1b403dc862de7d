#include <cmath>

#include "primitives.hpp"
#include "spaceship.hpp"

namespace nook::meshgen::ship {
namespace {

/// A rocket bell about the y axis, opening towards +y from its throat at y=0: cooling tubes along the
/// outside, hoops around them, a smooth inside with the injector's face at its end.
void add_bell(Model& model, double throat, double exit, double length, const dmat4& m) {
  const int tubes = 48, columns = tubes * 6, rows = 30;
  const auto radius = [&](double t) { return throat + (exit - throat) * std::pow(t, 0.62); };
  const Part outside = grid(rows + 1, columns,
                            [&](int r, int c) {
                              const double t = double(r) / rows, a = -2 * pi * c / columns;
                              const double rib =
                                  0.30 * pi * radius(t) / tubes * std::abs(std::sin(0.5 * tubes * a));
                              const double out = radius(t) + 0.010 + (r == rows ? 0.0 : 1.6 * rib);
                              return dvec3(out * std::cos(a), t * length, out * std::sin(a));
                            },
                            {.wrap = true});
  model.add("bell_ribs", "engine", shaded(outside, 50), m);

  std::vector<dvec2> inside = {
      {exit + 0.010, length}, {exit + 0.008, length + 0.006}, {exit, length + 0.006}};
  for (int i = 40; i >= 0; --i) inside.emplace_back(radius(i / 40.0), length * i / 40.0);
  for (int i = 1; i <= 12; ++i) {  // the chamber below the throat
    const double a = pi * i / 12;
    inside.emplace_back(throat + 0.35 * throat * (0.5 - 0.5 * std::cos(a)), -0.09 * i / 12.0);
  }
  inside.emplace_back(0, -0.09);
  model.add("bell_inside", "engine", shaded(lathe(inside, 96), 40), m);

  for (const double t : {0.10, 0.24, 0.40, 0.58, 0.78, 0.97})
    model.add("bell_hoops", "engine", torus(radius(t) + 0.016, 0.0085, 96, 10),
              m * translate({0, t * length, 0}));
  // Throat collar with its bolts, and the feed pipe around the bell's middle.
  const double collar = throat + 0.035;
  model.add("bell_collar", "engine",
            lathe({{0, -0.11},
                   {collar - 0.01, -0.11},
                   {collar, -0.10},
                   {collar, -0.01},
                   {collar - 0.012, 0.004},
                   {throat, 0.02}},
                  72),
            m);
  for (int i = 0; i < 24; ++i) {
    const double a = 2 * pi * i / 24;
    model.add("bell_bolts", "engine", cylinder(0.007, 0.012, 6, 0.002),
              m * translate({collar * std::cos(a), -0.055, collar * std::sin(a)}) *
                  frame({0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {0, 1, 0}));
  }
}

/// Nacelle skin about the y axis from the intake's lip (y=0) backwards (+y); ridges where it cools.
std::vector<dvec2> nacelle_profile() {
  std::vector<dvec2> p;
  for (int i = 0; i <= 10; ++i) p.emplace_back(0.150 + 0.004 * i, 0.30 - 0.027 * i);  // the duct, outwards
  for (int i = 1; i <= 12; ++i) {                                                     // the lip
    const double a = pi * i / 12;
    p.emplace_back(0.210 - 0.020 * std::cos(a), 0.030 - 0.030 * std::sin(a));
  }
  const auto body = [](double y) {
    return 0.230 + 0.042 * std::sin(pi * std::min(1.0, y / 0.75) * 0.5) -
           (y > 0.75 ? 0.16 * (y - 0.75) * (y - 0.75) / 0.35 : 0.0);
  };
  const auto seam = [&](double y) {
    p.emplace_back(body(y), y - 0.004);
    p.emplace_back(body(y) - 0.010, y - 0.0025);
    p.emplace_back(body(y) - 0.010, y + 0.0025);
    p.emplace_back(body(y), y + 0.004);
  };
  for (int i = 1; i <= 8; ++i) p.emplace_back(body(0.030 + 0.011 * i), 0.030 + 0.011 * i);
  seam(0.135);
  for (int i = 0; i <= 10; ++i) p.emplace_back(body(0.15 + 0.02 * i), 0.15 + 0.02 * i);
  seam(0.365);
  for (int i = 0; i < 14; ++i) {  // cooling ridges
    const double y = 0.385 + 0.020 * i, r = body(y);
    p.emplace_back(r - 0.016, y);
    p.emplace_back(r - 0.016, y + 0.008);
    p.emplace_back(r + 0.004, y + 0.0095);
    p.emplace_back(r + 0.004, y + 0.0175);
  }
  p.emplace_back(body(0.67), 0.67);
  for (int i = 0; i <= 8; ++i) p.emplace_back(body(0.675 + 0.02 * i), 0.675 + 0.02 * i);
  seam(0.855);
  for (int i = 0; i <= 8; ++i) p.emplace_back(body(0.87 + 0.02 * i), 0.87 + 0.02 * i);
  p.emplace_back(body(1.03) - 0.012, 1.042);
  p.emplace_back(0.175, 1.042);
  p.emplace_back(0.165, 0.99);
  p.emplace_back(0, 0.99);
  return p;
}

void add_nacelle(Model& model, const dmat4& m) {
  model.add("nacelle", "hull", shaded(lathe(nacelle_profile(), 144), 32), m);
  // The fan: hub, spinner and twisted blades before a dark disk.
  model.add("fan", "engine", lathe({{0, 0.29}, {0.16, 0.29}}, 72), m);
  model.add(
      "fan", "engine",
      shaded(lathe({{0, 0.10}, {0.018, 0.112}, {0.034, 0.140}, {0.046, 0.180}, {0.050, 0.24}, {0.050, 0.29}},
                   48),
             40),
      m);
  const int blades = 22;
  for (int i = 0; i < blades; ++i) {
    const Part blade =
        grid(13, 24,
             [&](int r, int c) {
               const double t = r / 12.0, chord = 0.035 + 0.015 * t, twist = glm::radians(25 + 40 * t);
               const double a = 2 * pi * c / 24;
               const dvec2 q(0.5 * chord * std::cos(a), 0.0035 * std::sin(a));
               return dvec3(0.045 + 0.115 * t, 0.215 - q.x * std::cos(twist) + q.y * std::sin(twist),
                            -(q.x * std::sin(twist) + q.y * std::cos(twist)));
             },
             {.wrap = true});
    model.add("fan_blades", "engine", shaded(blade, 60), m * rotate(360.0 * i / blades, {0, 1, 0}));
  }
  // Access covers around the cooling section, with a bolt in each corner.
  for (int i = 0; i < 10; ++i) {
    const double a = 36.0 * i + 18;
    const dmat4 at = m * rotate(a, {0, 1, 0}) * translate({0.262, 0.25, 0}) * rotate(-90, {0, 0, 1});
    model.add("nacelle_covers", "hull", rounded_box({0.07, 0.012, 0.05}, 0.006, 2), at);
    for (int k = 0; k < 4; ++k)
      model.add("bolts", "engine", cylinder(0.0055, 0.007, 6, 0.0015),
                at * translate({k & 1 ? 0.058 : -0.058, 0.011, k & 2 ? 0.038 : -0.038}));
  }
  add_bell(model, 0.100, 0.245, 0.42, m * translate({0, 1.08, 0}));
}

}  // namespace

void add_engines(Model& model) {
  const dmat4 backwards = rotate(90, {0, 0, 1});  // y of the engine is -x of the ship
  for (const double side : {1.0, -1.0})
    add_nacelle(model, translate({-0.05, nacelle_y, side * nacelle_z}) * backwards);
  add_bell(model, 0.11, 0.255, 0.42, translate({-1.58, 0.70, 0}) * backwards);
}

}  // namespace nook::meshgen::ship
