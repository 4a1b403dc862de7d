#include "spaceship.hpp"

#include <cmath>

#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

/// A floor that bends up into a wall behind the ship, all in front of the A3 camera's picture.
Part cyclorama() {
  std::vector<dvec2> profile = {{5.2, 0}};  // (x, y)
  const double bend = 2.2, start = -3.4;
  for (int i = 0; i <= 24; ++i) {
    const double a = 0.5 * pi * i / 24;
    profile.emplace_back(start - bend * std::sin(a), bend - bend * std::cos(a));
  }
  profile.emplace_back(start - bend, 4.6);
  return shaded(grid(int(profile.size()), 2,
                     [&](int r, int c) {
                       const dvec2 p = profile[std::size_t(r)];
                       return dvec3(p.x, p.y, c == 0 ? 6.5 : -6.5);
                     }),
                30);
}

/// A low round landing pad with a rim, two ring grooves; its top is y=0.
Part pad() {
  std::vector<dvec2> profile = {{2.36, -0.06}, {2.36, -0.02}, {2.34, 0.0}};
  for (const double r : {2.22, 1.30}) {
    profile.insert(profile.end(), {{r + 0.014, 0}, {r + 0.010, -0.014}, {r - 0.010, -0.014}, {r - 0.014, 0}});
  }
  profile.emplace_back(0, 0);
  return shaded(lathe(profile, 256), 30);
}

/// What stands around a parked ship: a ladder to the cockpit, crates, drums, a hose across the pad.
void add_equipment(Model& model) {
  const dmat4 ladder = translate({0.90, 0, -0.56}) * rotate(21, {1, 0, 0});
  for (const double side : {0.075, -0.075})
    model.add("ladder", "engine", rounded_box({0.010, 0.36, 0.014}, 0.004, 2),
              ladder * translate({side, 0.36, 0}));
  for (int i = 0; i < 8; ++i)
    model.add("ladder", "engine",
              tube({{-0.075, 0.06 + 0.085 * i, 0}, {0.075, 0.06 + 0.085 * i, 0}}, 0.007, 12), ladder);

  const auto crate = [&](const dvec3& at, double size, double turn) {
    const dmat4 m = translate(at + dvec3(0, size, 0)) * rotate(turn, {0, 1, 0});
    model.add("crates", "hull", rounded_box(dvec3(0.94 * size), 0.01, 2), m);
    for (int i = 0; i < 12; ++i) {  // the frame along the twelve edges
      const int axis = i / 4;
      dvec3 half((0.11 - 0.004 * axis) * size), offset(0);  // no two faces in one plane
      half[axis] = size;
      offset[(axis + 1) % 3] = (i & 1 ? 0.89 : -0.89) * size;
      offset[(axis + 2) % 3] = (i & 2 ? 0.89 : -0.89) * size;
      model.add("crates", "hull", rounded_box(half, 0.006, 2), m * translate(offset));
    }
  };
  crate({-0.30, 0, -1.25}, 0.13, 20);
  crate({-0.62, 0, -1.22}, 0.11, -12);
  crate({-0.42, 0.26, -1.24}, 0.09, 38);
  const Part drum = shaded(lathe({{0, 0},
                                  {0.085, 0},
                                  {0.090, 0.006},
                                  {0.090, 0.014},
                                  {0.085, 0.02},
                                  {0.085, 0.085},
                                  {0.090, 0.092},
                                  {0.085, 0.099},
                                  {0.085, 0.165},
                                  {0.090, 0.172},
                                  {0.085, 0.179},
                                  {0.085, 0.244},
                                  {0.090, 0.25},
                                  {0.090, 0.258},
                                  {0.085, 0.262},
                                  {0.080, 0.262},
                                  {0.078, 0.252},
                                  {0, 0.252}},
                                 64),
                           25);
  for (const dvec3& at : {dvec3(0.42, 0, -1.42), dvec3(0.60, 0, -1.46), dvec3(0.49, 0, -1.59)})
    model.add("drums", "engine", drum, translate(at) * scale(dvec3(0.8)));
  model.add("hoses", "engine",
            tube(spline({{0.35, 0.43, 0.18},
                         {0.36, 0.24, 0.24},
                         {0.42, 0.05, 0.34},
                         {0.62, 0.016, 0.52},
                         {0.50, 0.016, 0.85},
                         {0.10, 0.016, 0.95},
                         {-0.05, 0.016, 1.25},
                         {0.25, 0.016, 1.60},
                         {0.30, 0.016, 2.10},
                         {0.30, -0.04, 2.60}},
                        14),
                 0.016, 14));
}

}  // namespace

Model spaceship() {
  Model model;
  model.material("hull", 60);
  model.material("glass", 1000);
  model.material("engine", 300);
  model.material("ground", -1);
  ship::add_airframe(model);
  ship::add_engines(model);
  ship::add_landing_gear(model);
  ship::add_details(model);
  add_equipment(model);
  // The A3 camera looks along -x with z to the left: the nose comes towards it and to the left.
  model.transform(translate({-0.15, 0.0, -0.22}) * rotate(-53, {0, 1, 0}));
  model.add("pad", "ground", pad(), translate({0, 0, -0.15}));
  model.add("cyclorama", "ground", cyclorama(), translate({0, -0.06, -0.15}));
  return model;
}

}  // namespace nook::meshgen
