#include <cmath>

#include "primitives.hpp"
#include "room.hpp"

namespace nook::meshgen::room {
namespace {

/// Rush weaving on the xz plane: strands over and under each other.
Part weave(double half, int strands, double radius) {
  Part part;
  const double pitch = 2 * half / strands;
  for (int axis = 0; axis < 2; ++axis)
    for (int i = 0; i < strands; ++i) {
      std::vector<dvec3> path;
      for (int k = 0; k <= 2 * strands; ++k) {
        const double along = -half + 0.5 * pitch * k, across = -half + pitch * (i + 0.5);
        const double lift = k % 2 == 0 ? 0.0 : ((k / 2 + i + axis) % 2 ? 0.72 : -0.72) * radius;
        path.push_back(axis ? dvec3(across, lift, along) : dvec3(along, lift, across));
      }
      append(part, shaded(tube(path, 0.86 * radius, 8), 60));
    }
  return part;
}

Part turned_leg(double height, double r) {
  return shaded(lathe({{0, 0},
                       {0.55 * r, 0},
                       {0.62 * r, 0.01},
                       {0.60 * r, 0.05 * height},
                       {0.85 * r, 0.10 * height},
                       {0.62 * r, 0.13 * height},
                       {0.78 * r, 0.16 * height},
                       {0.62 * r, 0.19 * height},
                       {0.80 * r, 0.45 * height},
                       {0.95 * r, 0.62 * height},
                       {0.66 * r, 0.72 * height},
                       {0.98 * r, 0.75 * height},
                       {0.66 * r, 0.78 * height},
                       {r, 0.80 * height},
                       {r, height},
                       {0, height}},
                      40),
                32);
}

void add_chair(Model& model, const dmat4& m) {
  const double seat = 0.45;
  for (const double x : {-0.19, 0.19}) {
    model.add("chairs", "wood", turned_leg(seat + 0.02, 0.020), m * translate({x, 0, 0.18}));
    model.add("chairs", "wood",
              shaded(tube(spline({{x, 0, -0.20}, {x, 0.45, -0.19}, {x, 0.75, -0.22}, {x, 1.02, -0.28}}, 8),
                          0.018, 24)),
              m);
    for (const double y : {0.16, 0.27})
      model.add("chairs", "wood", tube({{x, y, -0.2}, {x, y, 0.18}}, 0.010, 16), m);
    model.add("chairs", "wood", tube({{x, seat, -0.2}, {x, seat, 0.18}}, 0.016, 16), m);
  }
  for (const double z : {-0.195, 0.18})
    for (const double y : {0.20, seat})
      model.add("chairs", "wood", tube({{-0.19, y, z}, {0.19, y, z}}, y == seat ? 0.016 : 0.010, 16), m);
  model.add("seats", "cloth", weave(0.185, 17, 0.010), m * translate({0, seat + 0.004, -0.01}));
  for (int i = 0; i < 4; ++i) {  // bowed slats of the back
    const double y = 0.60 + 0.115 * i, z = -0.205 - 0.20 * (y - 0.6) * (y - 0.6) - 0.09 * (y - 0.6);
    const Part slat = grid(3 + 14, 16,
                           [&](int row, int column) {
                             const double t = std::min(std::max(row - 1, 0), 14) / 14.0 * 2 - 1,
                                          a = 2 * pi * column / 16;
                             const double size = row == 0 || row == 16 ? 0 : 1;
                             return dvec3(0.19 * t, y + size * 0.032 * std::cos(a) * (1 - 0.3 * t * t),
                                          z - 0.030 * (1 - t * t) + size * 0.006 * std::sin(a));
                           },
                           {.wrap = true});
    model.add("chairs", "wood", shaded(slat, 50), m);
  }
}

void add_place(Model& model, const dmat4& m) {
  model.add("dishes", "glazed",
            vessel({{0.07, 0}, {0.075, 0.003}, {0.085, 0.006}, {0.10, 0.014}, {0.135, 0.020}}, 0.004, 96), m);
  model.add("dishes", "glazed",
            vessel({{0.04, 0}, {0.043, 0.004}, {0.045, 0.010}, {0.07, 0.03}, {0.082, 0.055}}, 0.004, 80),
            m * translate({0, 0.010, 0}));
  const dmat4 cup = m * translate({0.19, 0, -0.08});
  model.add("dishes", "glazed",
            vessel({{0.024, 0}, {0.026, 0.004}, {0.034, 0.02}, {0.038, 0.05}, {0.040, 0.085}}, 0.003, 64),
            cup);
  model.add(
      "dishes", "glazed",
      tube(
          spline(
              {{0.036, 0.068, 0}, {0.058, 0.070, 0}, {0.066, 0.048, 0}, {0.054, 0.026, 0}, {0.034, 0.022, 0}},
              8),
          0.0045, 14),
      cup);
  for (const double x : {-0.175, 0.165}) {  // knife and fork, plainly
    model.add("cutlery", "metal", rounded_box({0.007, 0.0025, 0.055}, 0.002, 2),
              m * translate({x, 0.0035, 0.06}));
    model.add("cutlery", "metal", rounded_box({0.004, 0.0018, 0.045}, 0.0015, 2),
              m * translate({x, 0.0035, -0.035}));
    for (int i = 0; x < 0 && i < 4; ++i)
      model.add("cutlery", "metal", rounded_box({0.0014, 0.0012, 0.025}, 0.001, 1),
                m * translate({x - 0.009 + 0.006 * i, 0.004, -0.10}));
    model.add("cutlery", "metal", rounded_box({0.011, 0.0015, x < 0 ? 0.009 : 0.05}, 0.0012, 2),
              m * translate({x, 0.0035, x < 0 ? -0.078 : -0.11}));
  }
}

}  // namespace

void add_dining(Model& model) {
  const dvec3 at(0.55, 0, -0.75);
  const double top = 0.76, half_w = 0.80, half_d = 0.46;
  const dmat4 table = translate(at);
  for (int i = 0; i < 6; ++i)  // planks
    model.add("table", "wood", rounded_box({half_w, 0.016, 0.0755}, 0.004),
              table * translate({0, top - 0.016, -half_d + 0.0767 + i * 0.1534}));
  for (const double s : {-1.0, 1.0}) {
    model.add("table", "wood", rounded_box({half_w - 0.08, 0.05, 0.012}, 0.004),
              table * translate({0, top - 0.082, s * (half_d - 0.08)}));
    model.add("table", "wood", rounded_box({0.012, 0.05, half_d - 0.08}, 0.004),
              table * translate({s * (half_w - 0.08), top - 0.082, 0}));
    for (const double t : {-1.0, 1.0})
      model.add("table", "wood", turned_leg(top - 0.032, 0.042),
                table * translate({s * (half_w - 0.09), 0, t * (half_d - 0.09)}));
  }
  for (const double x : {-0.40, 0.40}) {
    add_chair(model, table * translate({x, 0, 0.50}) * rotate(180 + (x < 0 ? 22 : -8), {0, 1, 0}));
    add_chair(model, table * translate({x + 0.03, 0, -0.52}) * rotate(x < 0 ? 5 : -10, {0, 1, 0}));
    add_place(model, table * translate({x, top, 0.27}));
    add_place(model, table * translate({x, top, -0.27}) * rotate(180, {0, 1, 0}));
  }
  // A jug, candlesticks, a bowl with fruit.
  const dmat4 jug = table * translate({0.02, top, 0.03});
  model.add("dishes", "glazed",
            vessel({{0.05, 0},
                    {0.055, 0.006},
                    {0.075, 0.05},
                    {0.080, 0.10},
                    {0.068, 0.15},
                    {0.045, 0.19},
                    {0.042, 0.22},
                    {0.055, 0.25}},
                   0.005, 96),
            jug);
  model.add(
      "dishes", "glazed",
      tube(spline({{0.045, 0.22, 0}, {0.10, 0.225, 0}, {0.12, 0.16, 0}, {0.10, 0.09, 0}, {0.076, 0.075, 0}},
                  10),
           0.009, 18),
      jug);
  for (const double x : {-0.22, 0.26}) {
    model.add("candles", "metal",
              lathe({{0, 0},
                     {0.05, 0},
                     {0.05, 0.006},
                     {0.02, 0.014},
                     {0.009, 0.03},
                     {0.014, 0.05},
                     {0.008, 0.07},
                     {0.012, 0.11},
                     {0.008, 0.13},
                     {0.024, 0.15},
                     {0.024, 0.156},
                     {0.013, 0.156},
                     {0.013, 0.175},
                     {0, 0.175}},
                    56),
              table * translate({x, top, 0}));
    model.add("candles", "cloth",
              lathe({{0, 0}, {0.0105, 0}, {0.0105, 0.17}, {0.006, 0.176}, {0, 0.174}}, 32),
              table * translate({x, top + 0.17, 0}));
  }
  // The lamp: a pleated shade open above and below, on its cord.
  const double lamp_y = 1.58;
  const Part shade = grid(
      8, 192,
      [&](int row, int column) {
        const double t[] = {0, 0.33, 0.66, 1, 1, 0.66, 0.33, 0}, a = -2 * pi * column / 192;
        const double r = 0.25 - 0.13 * t[row] + (column % 4 < 2 ? 0.006 : -0.006) - (row > 3 ? 0.003 : 0.0);
        return dvec3(r * std::cos(a), 0.22 * t[row], r * std::sin(a));
      },
      {.wrap = true, .wrap_rows = true});
  model.add("lamp", "cloth", shaded(shade, 25), translate({at.x, lamp_y, at.z}));
  model.add("lamp", "glazed", shaded(sphere(0.055, 48, 24), 180), translate({at.x, lamp_y + 0.06, at.z}));
  model.add("lamp", "metal", cylinder(0.022, 0.09, 32, 0.004), translate({at.x, lamp_y + 0.10, at.z}));
  model.add("lamp", "metal", tube({{at.x, lamp_y + 0.19, at.z}, {at.x, height - 0.05, at.z}}, 0.004, 12));
  for (int i = 0; i < 3; ++i)
    model.add("lamp", "metal",
              tube({{at.x, lamp_y + 0.16, at.z},
                    {at.x + 0.13 * std::cos(2.1 * i), lamp_y + 0.20, at.z + 0.13 * std::sin(2.1 * i)}},
                   0.003, 10));
}

void add_sofa(Model& model) {
  const dmat4 m = translate({-2.15, 0, 0.62}) * rotate(90, {0, 1, 0});  // faces +x
  model.add("sofa", "cloth", rounded_box({0.86, 0.13, 0.40}, 0.03, 4), m * translate({0, 0.24, 0}));
  for (const double s : {-1.0, 1.0}) {
    model.add("sofa", "cloth", rounded_box({0.10, 0.20, 0.42}, 0.07, 8), m * translate({s * 0.88, 0.46, 0}));
    for (const double z : {-0.32, 0.32})
      model.add("sofa", "wood", lathe({{0, 0}, {0.018, 0}, {0.028, 0.12}, {0, 0.12}}, 24),
                m * translate({s * 0.80, 0, z}));
    // Seat cushions: superellipsoids.
    const Part cushion =
        grid(49, 96,
             [&](int row, int column) {
               const double lat = pi * (row / 48.0 - 0.5), lon = -2 * pi * column / 96;
               const auto p = [](double v, double e) { return std::copysign(std::pow(std::abs(v), e), v); };
               const double ring = row == 0 || row == 48 ? 0 : p(std::cos(lat), 0.45);
               return dvec3(0.385 * ring * p(std::cos(lon), 0.3), 0.085 * p(std::sin(lat), 0.7),
                            0.36 * ring * p(std::sin(lon), 0.3));
             },
             {.wrap = true});
    model.add("cushions", "cloth", shaded(cushion, 180), m * translate({s * 0.39, 0.43, 0.05}));
    model.add("cushions", "cloth", shaded(cushion, 180),
              m * translate({s * 0.55, 0.66, -0.10}) * rotate(s * 12, {0, 0, 1}) * rotate(68, {1, 0, 0}) *
                  scale({0.58, 0.75, 0.58}));
  }
  // The buttoned back: a height field over diamonds, buttons in its hollows.
  const auto back = [&](double u, double v) {
    const double p = 9 * u + 2.5 * v, q = 9 * u - 2.5 * v;
    const double bulge = std::sqrt(std::abs(std::sin(pi * p) * std::sin(pi * q)));
    const double edge = std::min(1.0, 12 * std::min(std::min(u, 1 - u), std::min(v, 1 - v)));
    return dvec3(1.56 * (u - 0.5), 0.40 + 0.52 * v,
                 -0.30 - 0.10 * v + (0.085 * bulge + 0.02) * std::sqrt(edge));
  };
  model.add("sofa_back", "cloth",
            shaded(grid(91, 271, [&](int r, int c) { return back(c / 270.0, r / 90.0); }), 80), m);
  model.add("sofa", "cloth", rounded_box({0.82, 0.30, 0.09}, 0.04, 6),
            m * translate({0, 0.64, -0.44}) * rotate(-10.9, {1, 0, 0}));
  for (int i = 0; i <= 18; ++i)
    for (int k = 0; k <= 5; ++k) {
      const double u = i / 18.0, v = k / 5.0;
      if ((i + k) % 2 || u < 0.03 || u > 0.97 || v < 0.1 || v > 0.9) continue;
      model.add("buttons", "cloth", shaded(sphere(0.011, 16, 8), 180),
                m * translate(back(u, v)) * scale({1, 1, 0.7}));
    }
  // A basket of balls beside it.
  const dmat4 basket = translate({-1.30, 0.012, 1.75});
  for (int i = 0; i < 14; ++i) {
    std::vector<dvec3> ring;
    for (int k = 0; k <= 96; ++k) {
      const double a = 2 * pi * k / 96,
                   r = 0.15 + 0.05 * std::sin(pi * i / 26.0) + 0.006 * ((k / 2 + i) % 2 ? 1 : -1) * (k % 2);
      ring.emplace_back(r * std::cos(a), 0.012 + 0.021 * i, r * std::sin(a));
    }
    model.add("basket", "wood", shaded(tube(ring, 0.0095, 8), 60), basket);
  }
  for (int i = 0; i < 48; ++i) {
    const double a = 2 * pi * i / 48;
    std::vector<dvec3> stake;
    for (int k = 0; k <= 10; ++k)
      stake.emplace_back((0.15 + 0.05 * std::sin(pi * k * 1.3 / 26.0)) * std::cos(a), 0.031 * k,
                         (0.15 + 0.05 * std::sin(pi * k * 1.3 / 26.0)) * std::sin(a));
    model.add("basket", "wood", tube(stake, 0.004, 8), basket);
  }
  for (int i = 0; i < 8; ++i)
    model.add(
        "balls", "cloth", shaded(sphere(0.065, 56, 28), 180),
        basket * translate({(i < 7 ? 0.10 : 0.0) * std::cos(2 * pi * i / 7), 0.25 + (i < 7 ? 0.0 : 0.08),
                            (i < 7 ? 0.10 : 0.0) * std::sin(2 * pi * i / 7)}));
}

}  // namespace nook::meshgen::room
