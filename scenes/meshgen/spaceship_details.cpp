#include <cmath>

#include "primitives.hpp"
#include "spaceship.hpp"

namespace nook::meshgen::ship {
namespace {

/// A louvred vent on the xz plane, its frame standing on y=0.
Part vent(double length, double width, int slats) {
  Part part;
  for (const double s : {1.0, -1.0}) {
    append(part,
           transformed(rounded_box({length, 0.014, 0.008}, 0.004, 2), translate({0, 0.006, s * width})));
    append(part,
           transformed(rounded_box({0.008, 0.014, width}, 0.004, 2), translate({s * length, 0.006, 0})));
  }
  for (int i = 0; i < slats; ++i)
    append(part, transformed(
                     box({0.0025, 0.012, width - 0.006}),
                     translate({length * (2.0 * (i + 0.5) / slats - 1), 0.004, 0}) * rotate(38, {0, 0, 1})));
  return part;
}

/// A round hatch with a rim, a dished lid, a wheel and bolts.
void add_hatch(Model& model, double radius, const dmat4& m) {
  model.add("hatches", "hull",
            lathe({{radius + 0.016, -0.02},
                   {radius + 0.016, 0.008},
                   {radius + 0.010, 0.013},
                   {radius + 0.002, 0.013},
                   {radius - 0.003, 0.0},
                   {radius - 0.012, 0.0},
                   {radius - 0.016, 0.010},
                   {0.6 * radius, 0.016},
                   {0, 0.018}},
                  64),
            m);
  model.add("hatches", "engine", torus(0.38 * radius, 0.006, 40, 10), m * translate({0, 0.030, 0}));
  for (int i = 0; i < 12; ++i)
    model.add("bolts", "engine", cylinder(0.0045, 0.006, 6, 0.0012),
              m * rotate(30.0 * i, {0, 1, 0}) * translate({radius + 0.007, 0.012, 0}));
}

void add_bolts(Model& model, const Hull& hull) {
  for (const double a : {0.10, 0.15, 0.205, 0.26, 0.315, 0.36, 0.405})
    for (int i = 0; i < 58; ++i) {
      const double s = 0.20 + 0.0135 * i;
      for (const double turn : {a + 0.008, 1 - a - 0.008})
        model.add("bolts", "engine", cylinder(0.0042, 0.005, 6, 0.0012), hull.mount(s, turn, 0.0));
    }
}

void add_pipes(Model& model, const Hull& hull) {
  // Bundles along the lower flank; each pipe keeps its turn, dives in at its ends, and is clamped on the way.
  const double turns[] = {0.112, 0.121, 0.130, 0.185};
  const double radii[] = {0.011, 0.011, 0.011, 0.017};
  for (int k = 0; k < 4; ++k)
    for (const bool port : {false, true}) {
      const auto on = [&](double s, double turn, double height) {
        const double a = port ? 1 - turn : turn;
        return hull.point(s, a) + height * hull.normal(s, a);
      };
      std::vector<dvec3> path = {on(0.27 + 0.02 * k, turns[k], -0.03)};
      for (int i = 0; i <= 16; ++i) {
        const double s = 0.29 + 0.02 * k + i * (0.56 - 0.03 * k) / 16;
        const double jog = i > 9 && k < 3 ? 0.012 : 0.0;
        path.push_back(on(s, turns[k] + jog, 0.018));
      }
      path.push_back(on(0.875 - 0.01 * k, turns[k], -0.03));
      model.add("pipes", "engine", tube(spline(path, 5), radii[k], 14));
      for (std::size_t i = 2; i + 2 < path.size(); i += 2)
        model.add("pipe_clamps", "engine", torus(radii[k] + 0.003, 0.0055, 20, 8),
                  frame(path[i], path[i + 1] - path[i - 1], {0, 1, 0}));
    }
}

void add_spine(Model& model, const Hull& hull) {
  // Equipment along the spine: boxes of hashed sizes in two rows between low rails.
  for (int i = 0; i < 22; ++i)
    for (const double row : {0.478, 0.522}) {
      const double s = 0.50 + 0.0195 * i, h = 0.012 + 0.026 * hash01(std::uint32_t(i), row > 0.5 ? 7 : 8);
      const double depth = 0.018 + 0.012 * hash01(std::uint32_t(i), 9);
      model.add("spine", "hull", rounded_box({0.026, h, depth}, 0.005, 2), hull.mount(s, row));
    }
  for (const double row : {0.452, 0.548}) {
    std::vector<dvec3> path;
    for (int i = 0; i <= 30; ++i)
      path.push_back(hull.point(0.49 + i * 0.0146, row) + 0.012 * hull.normal(0.49 + i * 0.0146, row));
    model.add("spine", "engine", tube(path, 0.009, 12));
  }
  for (int i = 0; i < 3; ++i) {
    const dmat4 at = hull.mount(0.455 + 0.013 * i, 0.5 + 0.02 * (i - 1));
    const double height = 0.34 - 0.09 * i;
    model.add("antennas", "engine",
              lathe({{0, 0},
                     {0.016, 0},
                     {0.016, 0.012},
                     {0.006, 0.03},
                     {0.0045, 0.6 * height},
                     {0.0025, height},
                     {0, height + 0.003}},
                    16),
              at);
  }
  model.add("dome", "hull", shaded(sphere(0.062, 64, 32), 180), hull.mount(0.435, 0.5, -0.005));
  model.add("dome", "hull", torus(0.064, 0.009, 64, 12), hull.mount(0.435, 0.5, 0.006));
}

void add_turret(Model& model) {
  const dmat4 at = translate({1.47, 0.455, 0});
  model.add("turret", "engine", shaded(sphere(0.062, 48, 24), 180), at);
  model.add("turret", "engine", torus(0.066, 0.010, 48, 12), at * translate({0, 0.012, 0}));
  for (const double side : {0.026, -0.026}) {
    const dmat4 gun = at * translate({0.03, -0.022, side}) * rotate(-90, {0, 0, 1});
    model.add("turret", "engine",
              lathe({{0, 0},
                     {0.014, 0},
                     {0.014, 0.07},
                     {0.0085, 0.078},
                     {0.0085, 0.20},
                     {0.0115, 0.205},
                     {0.0115, 0.24},
                     {0.006, 0.24},
                     {0.006, 0.20},
                     {0, 0.20}},
                    24),
              gun);
    for (int i = 0; i < 5; ++i)
      model.add("turret", "engine", torus(0.0095, 0.003, 20, 8), gun * translate({0, 0.09 + 0.02 * i, 0}));
  }
}

/// A pitot probe, collars behind it, and slots beside the nose wheel.
void add_nose(Model& model, const Hull& hull) {
  const dmat4 forwards = translate({1.93, 0.555, 0}) * rotate(-90, {0, 0, 1});
  model.add(
      "nose", "engine",
      lathe({{0, 0}, {0.022, 0}, {0.022, 0.03}, {0.012, 0.045}, {0.0075, 0.06}, {0.006, 0.14}, {0, 0.143}},
            24),
      forwards);
  for (const double s : {0.036, 0.090}) {
    std::vector<dvec3> ring;
    for (int i = 0; i <= 64; ++i) ring.push_back(hull.point(s, i / 64.0));
    model.add("nose", "hull", tube(ring, 0.0055, 10));
  }
  for (const double turn : {0.19, 0.81})
    for (int i = 0; i < 7; ++i)
      model.add("nose", "engine", rounded_box({0.006, 0.006, 0.024}, 0.003, 2),
                hull.mount(0.15 + 0.011 * i, turn));
}

/// Pods at the fins' tips and tanks on pylons under the outer wings.
void add_stores(Model& model) {
  const auto pod = [](double radius, double length, int rings) {
    std::vector<dvec2> profile = {{0, 0}};
    for (int i = 1; i <= 10; ++i) {
      const double a = 0.5 * pi * i / 10;
      profile.emplace_back(radius * std::sin(a), 2.5 * radius * (1 - std::cos(a)));
    }
    for (int i = 0; i < rings; ++i) {
      const double y = 2.5 * radius + (length - 5 * radius) * (i + 0.5) / rings;
      profile.insert(
          profile.end(),
          {{radius, y - 0.005}, {0.90 * radius, y - 0.004}, {0.90 * radius, y + 0.004}, {radius, y + 0.005}});
    }
    profile.insert(profile.end(), {{radius, length - 2.5 * radius},
                                   {0.66 * radius, length - radius},
                                   {0.60 * radius, length},
                                   {0.45 * radius, length},
                                   {0.45 * radius, length - 0.02},
                                   {0, length - 0.02}});
    return shaded(lathe(profile, 48), 40);
  };
  const dmat4 backwards = rotate(90, {0, 0, 1});
  add_pair(model, "tip_pods", "hull", pod(0.030, 0.52, 4),
           translate({-1.16, 1.475, nacelle_z + 0.155}) * backwards);
  add_pair(model, "tanks", "hull", pod(0.062, 0.72, 3),
           translate({-0.62, 0.475, nacelle_z + 0.34}) * backwards);
  add_pair(model, "pylons", "hull", rounded_box({0.14, 0.05, 0.012}, 0.008, 2),
           translate({-0.94, 0.545, nacelle_z + 0.34}));
}

}  // namespace

void add_details(Model& model) {
  const Hull hull = fuselage();
  add_bolts(model, hull);
  add_pipes(model, hull);
  add_spine(model, hull);
  add_turret(model);
  for (const bool port : {false, true}) {
    const auto turn = [&](double a) { return port ? 1 - a : a; };
    model.add("vents", "hull", vent(0.115, 0.045, 14), hull.mount(0.50, turn(0.338)));
    model.add("vents", "hull", vent(0.075, 0.040, 10), hull.mount(0.592, turn(0.338)));
    model.add("vents", "hull", vent(0.060, 0.035, 9), hull.mount(0.885, turn(0.385)));
    model.add("vents", "hull", vent(0.075, 0.035, 10), hull.mount(0.33, turn(0.235)));
    add_hatch(model, 0.060, hull.mount(0.425, turn(0.270)));
    add_hatch(model, 0.040, hull.mount(0.255, turn(0.300)));
    add_hatch(model, 0.045, hull.mount(0.68, turn(0.430)));
  }
  add_nose(model, hull);
  add_stores(model);
  // Ribs around the tail, between the fuselage and its bell.
  for (int i = 0; i < 5; ++i)
    model.add("tail_ribs", "engine", torus(0.175 - 0.010 * i, 0.014, 72, 10),
              translate({-1.495 - 0.022 * i, 0.70, 0}) * rotate(90, {0, 0, 1}));
}

}  // namespace nook::meshgen::ship
