#include <cmath>

#include "primitives.hpp"
#include "spaceship.hpp"

namespace nook::meshgen::ship {

Hull fuselage() {
  return Hull({{1.95, 0.555, 0.020, 0.014, 0.014, 2.0},
               {1.88, 0.556, 0.070, 0.038, 0.036, 2.1},
               {1.70, 0.565, 0.132, 0.078, 0.075, 2.3},
               {1.40, 0.590, 0.205, 0.140, 0.130, 2.6},
               {1.00, 0.625, 0.280, 0.200, 0.190, 2.9},
               {0.50, 0.650, 0.345, 0.260, 0.235, 3.1},
               {0.00, 0.660, 0.385, 0.305, 0.250, 3.2},
               {-0.50, 0.665, 0.395, 0.320, 0.245, 3.2},
               {-1.00, 0.670, 0.370, 0.300, 0.225, 3.1},
               {-1.30, 0.675, 0.325, 0.265, 0.205, 2.8},
               {-1.50, 0.680, 0.275, 0.235, 0.190, 2.4}});
}

void add_pair(Model& model, const char* group, const char* material, const Part& part, const dmat4& m) {
  const Part ready = part.triangle_normals.empty() ? shaded(part) : part;
  model.add(group, material, ready, m);
  model.add(group, material, ready, scale({1, 1, -1}) * m);
}

namespace {

/// A wing or fin: rounded-wedge sections from root (y=0) to tip (y=span); x is the chord, z the thickness.
/// Grooves: one across at each of the given shares of the span, one along the hinge of the flap.
Part blade(double span, double root_chord, double tip_chord, double sweep, double thickness) {
  const int around = 64, rows = 44;
  const auto section = [&](double t, double a) {
    const double chord = root_chord + t * (tip_chord - root_chord);
    const double u = 0.5 - 0.5 * std::cos(2 * pi * a);  // 0 leading edge, 1 trailing edge
    const double half =
        thickness * (1 - 0.55 * t) * 2.6 *
        (0.2969 * std::sqrt(u) - 0.126 * u - 0.3516 * u * u + 0.2843 * u * u * u - 0.0955 * u * u * u * u);
    return dvec3(0.5 * root_chord - sweep * t - u * chord, t * span, (a < 0.5 ? -1 : 1) * half);
  };
  return shaded(grid(rows + 3, around,
                     [&](int r, int c) {
                       const double a = (c + 0.5) / around;
                       if (r == 0 || r == rows + 2) {
                         const dvec3 front = section(r == 0 ? 0 : 1, 0.0),
                                     back = section(r == 0 ? 0 : 1, 0.5);
                         return 0.5 * (front + back);
                       }
                       double t = double(r - 1) / rows;
                       // Every eleventh row pair is squeezed to a groove.
                       const int k = (r - 1) % 11;
                       const bool groove = (k == 5 || k == 6) && r > 3 && r < rows - 2;
                       t = k == 5 || k == 6 ? (double(r - 1 - k) + 5.5 + (k == 5 ? -0.06 : 0.06)) / rows : t;
                       dvec3 p = section(t, a);
                       if (k == 4 || k == 7)
                         p = section((double(r - 1 - k) + 5.5 + (k == 4 ? -0.12 : 0.12)) / rows, a);
                       if (groove) p.z *= 0.86;
                       return p;
                     },
                     {.wrap = true}),
                28);
}

/// The bubble over the seats with its frames, at the hull's shoulder line.
void add_canopy(Model& model) {
  const auto bubble = [](double t, double a, double swell) {
    // t: 0 front, 1 back; a: -1 port sill to 1 starboard sill
    const double profile = std::pow(std::sin(pi * std::pow(t, 0.72)), 0.62);
    const double angle = a * 0.62 * pi;
    return dvec3(1.36 - 0.92 * t, 0.715 + 0.10 * t + (0.165 * profile + swell) * std::cos(angle),
                 (0.155 * profile + swell) * std::sin(angle));
  };
  model.add("canopy", "glass",
            shaded(grid(61, 49, [&](int r, int c) { return bubble(r / 60.0, 1 - c / 24.0, 0.0); }), 60));
  for (const double t : {0.22, 0.42, 0.64, 0.84}) {
    std::vector<dvec3> path;
    for (int i = 0; i <= 40; ++i) path.push_back(bubble(t, i / 20.0 - 1, 0.003));
    model.add("canopy_frame", "hull", tube(path, 0.011, 10));
  }
  for (const double a : {-0.60, -0.18, 0.18, 0.60}) {
    std::vector<dvec3> path;
    for (int i = 1; i < 60; ++i) path.push_back(bubble(i / 60.0, a, 0.002));
    model.add("canopy_frame", "hull", tube(path, std::abs(a) > 0.5 ? 0.014 : 0.008, 10));
  }
}

}  // namespace

void add_airframe(Model& model) {
  const Hull hull = fuselage();
  Hull::Panels panels;
  for (const double s : {0.055, 0.12, 0.185, 0.235, 0.30, 0.345, 0.40, 0.455, 0.50, 0.54, 0.60, 0.645, 0.70,
                         0.745, 0.79, 0.85, 0.89, 0.94, 0.975})
    panels.stations.push_back(s);
  panels.stringers = {0.035, 0.10, 0.15, 0.205, 0.26, 0.315, 0.36, 0.405, 0.455};
  panels.merged_before = 0.185;
  model.add("fuselage", "hull", hull.skin(panels));
  add_canopy(model);

  // Wings: stubs into the nacelles, blades outside of them that droop, fins on top canted outwards.
  const dmat4 outwards = rotate(90, {1, 0, 0});
  add_pair(model, "wing", "hull", blade(0.42, 0.92, 0.74, 0.10, 0.105),
           translate({-0.68, 0.66, 0.25}) * outwards);
  add_pair(model, "wing", "hull", blade(0.62, 0.78, 0.26, 0.50, 0.05),
           translate({-0.70, 0.63, nacelle_z + 0.16}) * rotate(16, {1, 0, 0}) * outwards);
  add_pair(model, "fin", "hull", blade(0.66, 0.80, 0.34, 0.52, 0.05),
           translate({-0.98, nacelle_y + 0.17, nacelle_z}) * rotate(14, {1, 0, 0}));
  add_pair(model, "canard", "hull", blade(0.30, 0.34, 0.14, 0.20, 0.028),
           translate({1.18, 0.60, 0.20}) * rotate(-8, {1, 0, 0}) * outwards);
}

}  // namespace nook::meshgen::ship
