#include <cmath>

#include "primitives.hpp"
#include "room.hpp"

namespace nook::meshgen::room {
namespace {

/// A book standing on y=0: x is its thickness, its spine faces +z. Two boards, a rounded spine with raised
/// bands, the paper between.
Part book(double thick, double tall, double deep, int bands) {
  Part part;
  const double board = 0.0015;
  for (const double s : {-1.0, 1.0})
    append(part, shaded(transformed(rounded_box({board, 0.5 * tall, 0.5 * deep}, 0.001, 1),
                                    translate({s * (0.5 * thick - board), 0.5 * tall, 0}))));
  append(part, shaded(transformed(box({0.5 * thick - 2 * board, 0.5 * tall - 0.004, 0.5 * deep - 0.004}),
                                  translate({0, 0.5 * tall, 0}))));
  const Part spine = shaded(grid(
      6, 10,
      [&](int row, int column) {
        const double a = -2 * pi * column / 10;
        const double y[] = {0, 0, 0.001, tall - 0.001, tall, tall};
        const double size = row == 0 || row == 5 ? 0.0 : row == 1 || row == 4 ? 0.985 : 1.0;
        return dvec3(0.5 * thick * std::cos(a) * size, y[row],
                     0.5 * deep - 0.002 + 0.35 * thick * std::sin(a) * size * (std::sin(a) > 0 ? 1.0 : 0.2));
      },
      {.wrap = true}));
  append(part, spine);
  for (int i = 0; i < bands; ++i)
    append(part,
           shaded(transformed(torus(0.5 * thick, 0.002, 12, 4),
                              translate({0, tall * (0.16 + 0.68 * i / (bands - 1)), 0.5 * deep - 0.002}) *
                                  scale({1, 1, 0.7}))));
  return part;
}

}  // namespace

void add_bookcase(Model& model) {
  const double depth = 0.15, back = -half_z + 0.04, front_z = back + 2 * depth;
  const double left = -2.85, right = 1.35, top = 2.36;
  const int columns = 5, shelves = 7;
  const double pitch = (right - left) / columns, rise = (top - 0.10) / shelves;
  const double zc = back + depth;
  model.add("bookcase", "wood", box({0.5 * (right - left), 0.5 * (top - 0.02), 0.008}),
            translate({0.5 * (left + right), 0.5 * top + 0.01, back + 0.008}));
  for (int c = 0; c <= columns; ++c)
    model.add("bookcase", "wood", rounded_box({0.014, 0.5 * top, depth}, 0.004),
              translate({left + c * pitch, 0.5 * top + 0.012, zc}));
  for (int s = 0; s <= shelves; ++s)
    model.add("bookcase", "wood", rounded_box({0.5 * (right - left), 0.011, depth - 0.004}, 0.004),
              translate({0.5 * (left + right), 0.10 + s * rise, zc}));
  model.add("bookcase", "wood", rounded_box({0.5 * (right - left) + 0.03, 0.018, depth + 0.025}, 0.008),
            translate({0.5 * (left + right), top + 0.02, zc}));
  for (int c = 0; c < columns; ++c)
    for (int s = 0; s < shelves; ++s) {
      const std::uint32_t cell = std::uint32_t(16 * c + s);
      const double y = 0.10 + s * rise + 0.011, x0 = left + c * pitch + 0.018,
                   x1 = left + (c + 1) * pitch - 0.018;
      const bool gap = hash01(cell, 40) < 0.55;
      double x = x0;
      const double end = gap ? x0 + (0.45 + 0.35 * hash01(cell, 41)) * (x1 - x0) : x1;
      for (std::uint32_t k = 0;; ++k) {
        const std::uint32_t id = 256 * cell + k;
        const double thick = 0.016 + 0.034 * hash01(id, 1) * hash01(id, 2),
                     tall = 0.17 + 0.115 * hash01(id, 3);
        const double deep = 0.13 + 0.09 * hash01(id, 4);
        if (x + thick > end) break;
        const bool last = gap && x + thick + 0.05 > end;
        model.add("books", "paper", book(thick, tall, deep, hash01(id, 5) < 0.4 ? 4 : 0),
                  translate({x + 0.5 * thick + (last ? 0.02 : 0.0), y,
                             front_z - 0.03 - 0.5 * deep - 0.05 * hash01(id, 6)}) *
                      rotate(last ? 9 : 0, {0, 0, 1}) * rotate(3 * (hash01(id, 7) - 0.5), {0, 1, 0}));
        x += thick + 0.0012;
      }
      if (!gap) continue;
      // The rest of the shelf: a pile of books, a bowl, or a ball on a ring.
      const double middle = 0.5 * (end + 0.03 + x1), room_left = x1 - end - 0.03;
      const int kind = room_left < 0.2 ? 2 : int(3 * hash01(cell, 42));
      double pile = y;
      for (std::uint32_t k = 0; kind == 0 && k < 4; ++k) {
        const double thick = 0.018 + 0.02 * hash01(cell, 50 + k), tall = 0.20 - 0.018 * k;
        model.add("books", "paper", book(thick, tall, 0.14 - 0.006 * k, 0),
                  translate({middle + 0.5 * tall, pile + 0.5 * thick, zc + 0.05}) *
                      rotate(8 * (hash01(cell, 60 + k) - 0.5), {0, 1, 0}) * rotate(90, {0, 0, 1}));
        pile += thick + 0.001;
      }
      if (kind == 1)
        model.add(
            "ornaments", "glazed",
            vessel({{0.03, 0}, {0.034, 0.004}, {0.030, 0.015}, {0.06, 0.04}, {0.085, 0.075}, {0.092, 0.11}},
                   0.005, 64),
            translate({middle, y, zc + 0.03}));
      if (kind == 2) {
        model.add("ornaments", "metal", torus(0.03, 0.007, 48, 12),
                  translate({middle, y + 0.007, zc + 0.04}));
        model.add("ornaments", "glazed", shaded(sphere(0.05, 64, 32), 180),
                  translate({middle, y + 0.058, zc + 0.04}));
      }
    }
}

void add_sideboard(Model& model) {
  // A low cabinet with framed doors; its top is crowded.
  const double x = -half_x + 0.26, z = -1.35, half = 0.62, top = 0.86;
  model.add("sideboard", "wood", rounded_box({0.20, 0.36, half}, 0.006), translate({x, 0.46, z}));
  model.add("sideboard", "wood", rounded_box({0.225, 0.018, half + 0.03}, 0.008),
            translate({x, top - 0.018, z}));
  for (int i = 0; i < 3; ++i) {
    const double zd = z + (i - 1) * 0.405;
    for (const double s : {-1.0, 1.0}) {
      model.add("sideboard", "wood", rounded_box({0.010, 0.32, 0.028}, 0.005),
                translate({x + 0.205, 0.46, zd + s * 0.165}));
      model.add("sideboard", "wood", rounded_box({0.010, 0.028, 0.19}, 0.005),
                translate({x + 0.205, 0.46 + s * 0.29, zd}));
    }
    for (int k = 0; k < 14; ++k)  // louvres
      model.add("sideboard", "wood", rounded_box({0.010, 0.003, 0.138}, 0.0025, 1),
                translate({x + 0.203, 0.215 + 0.0375 * k, zd}) * rotate(-40, {0, 0, 1}));
    model.add("knobs", "metal",
              lathe({{0, 0},
                     {0.008, 0},
                     {0.005, 0.008},
                     {0.006, 0.016},
                     {0.013, 0.022},
                     {0.014, 0.028},
                     {0.009, 0.034},
                     {0, 0.036}},
                    32),
              translate({x + 0.215, 0.50, zd + 0.165}) * rotate(-90, {0, 0, 1}));
  }
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      model.add(
          "sideboard", "wood",
          lathe({{0, 0}, {0.016, 0}, {0.020, 0.012}, {0.018, 0.03}, {0.026, 0.07}, {0.026, 0.11}, {0, 0.11}},
                32),
          translate({x + 0.16 * a, 0, z + 0.56 * b}));
  for (int i = 0; i < 17; ++i) {
    const std::uint32_t id = std::uint32_t(i);
    const double r = 0.024 + 0.012 * hash01(id, 71), h = 0.20 + 0.14 * hash01(id, 72);
    model.add("bottles", "glazed",
              vessel({{0.9 * r, 0},
                      {r, 0.006},
                      {r, 0.52 * h},
                      {0.96 * r, 0.57 * h},
                      {0.75 * r, 0.65 * h},
                      {0.42 * r, 0.73 * h},
                      {0.36 * r, 0.80 * h},
                      {0.36 * r, 0.93 * h},
                      {0.46 * r, 0.94 * h},
                      {0.46 * r, 0.97 * h},
                      {0.38 * r, 0.98 * h},
                      {0.38 * r, h}},
                     0.003, 48),
              translate({x - 0.11 + 0.085 * (i % 3), top, z - 0.54 + 0.078 * (i / 3 + i % 3 * 0.33) * 1.35}));
  }
  model.add("bowls", "glazed",
            vessel({{0.05, 0}, {0.055, 0.006}, {0.05, 0.018}, {0.10, 0.05}, {0.14, 0.10}, {0.15, 0.125}},
                   0.006, 96),
            translate({x + 0.02, top, z + 0.42}));
  for (int i = 0; i < 7; ++i)
    model.add("fruit", "glazed", shaded(sphere(0.038, 48, 24), 180),
              translate({x + 0.02 + (i < 6 ? 0.058 * std::cos(pi * i / 3) : 0), top + (i < 6 ? 0.092 : 0.135),
                         z + 0.42 + (i < 6 ? 0.058 * std::sin(pi * i / 3) : 0)}));
}

}  // namespace nook::meshgen::room
