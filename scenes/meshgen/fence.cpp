#include "foliage.hpp"
#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

/// A picket, 60 mm by 12 mm with a pointed head, standing on y=0.
Part picket(double height) {
  Part part = grid(7, 4,
                   [&](int row, int column) {
                     const double y[] = {0, 0, height - 0.06, height - 0.012, height, height, height};
                     const double half[] = {0, 0.030, 0.030, 0.004, 0.0, 0.0, 0.0};
                     const dvec2 corners[] = {{1, -1}, {-1, -1}, {-1, 1}, {1, 1}};
                     const dvec2 c = corners[column];
                     return dvec3(half[row] * c.x, y[row], row == 0 || row > 3 ? 0 : 0.006 * c.y);
                   },
                   {.wrap = true});
  return shaded(part, 20);
}

Part jar(double radius, double height) {
  return shaded(lathe({{0, 0},
                       {0.92 * radius, 0},
                       {radius, 0.06 * height},
                       {radius, 0.66 * height},
                       {0.62 * radius, 0.84 * height},
                       {0.62 * radius, height},
                       {0.52 * radius, height},
                       {0.52 * radius, 0.80 * height},
                       {0, 0.78 * height}},
                      28),
                50);
}

}  // namespace

Model fence() {
  Model model;
  model.material("ground", -1);
  model.material("wood", 20);
  model.material("wire", 200);
  model.add("floor", "ground", box({2.6, 0.05, 2.6}), translate({0, -0.05, 0}));
  model.add("wall", "ground", box({2.6, 1.2, 0.05}), translate({0, 1.2, -0.75}));

  // Shelves of 8 mm boards on the wall, with jars.
  for (int shelf = 0; shelf < 4; ++shelf) {
    const double y = 0.28 + 0.30 * shelf;
    model.add("shelves", "wood", box({1.5, 0.004, 0.12}), translate({0, y, -0.58}));
    for (int i = 0; i < 9; ++i)
      model.add("brackets", "wire", box({0.003, 0.05, 0.10}),
                translate({-1.44 + 0.36 * i, y - 0.054, -0.60}));
    for (int i = 0; i < 22; ++i) {
      const std::uint32_t id = std::uint32_t(100 * shelf + i);
      if (hash01(id, 1) < 0.3) continue;
      model.add("jars", "wire", jar(0.032 + 0.022 * hash01(id, 2), 0.10 + 0.11 * hash01(id, 3)),
                translate({-1.40 + 0.133 * i, y + 0.004, -0.58 + 0.06 * (hash01(id, 4) - 0.5)}));
    }
  }

  // The fence in front of them: pickets on two rails, each a little out of true.
  for (int i = 0; i < 31; ++i) {
    const std::uint32_t id = std::uint32_t(i);
    model.add("pickets", "wood", picket(0.92 + 0.06 * hash01(id, 5)),
              translate({-1.5 + 0.1 * i, 0.02, 0.30}) * rotate(2.4 * (hash01(id, 6) - 0.5), {0, 0, 1}) *
                  rotate(3.0 * (hash01(id, 7) - 0.5), {1, 0, 0}));
  }
  for (const double y : {0.22, 0.72})
    model.add("rails", "wood", box({1.56, 0.03, 0.009}), translate({0, y, 0.283}));
  for (int i = 0; i < 5; ++i)
    model.add("posts", "wood", rounded_box({0.035, 0.52, 0.035}, 0.006, 2),
              translate({-1.5 + 0.75 * i, 0.52, 0.238}));

  // Wires of 3 mm between fence and shelves, and the mesh of a trellis.
  for (int i = 0; i < 12; ++i)
    model.add("wires", "wire", tube({{-1.6, 0.1 + 0.1 * i, -0.15}, {1.6, 0.1 + 0.1 * i, -0.15}}, 0.0015, 10));
  for (int i = 0; i < 33; ++i)
    model.add("wires", "wire",
              tube({{-1.6 + 0.1 * i, 0.0, -0.152}, {-1.6 + 0.1 * i, 1.3, -0.152}}, 0.0015, 10));

  // A vine with thin leaves on the trellis.
  for (int v = 0; v < 7; ++v) {
    const std::uint32_t id = std::uint32_t(v);
    std::vector<dvec3> path;
    for (int i = 0; i <= 12; ++i)
      path.emplace_back(-1.3 + 0.42 * v + 0.09 * (hash01(id, std::uint32_t(10 + i)) - 0.5), 0.1 * i,
                        -0.15 + (i % 2 ? 0.012 : -0.012));
    const std::vector<dvec3> stem = spline(path, 6);
    model.add("vine", "wood", tube(stem, 0.005, 8));
    for (std::size_t i = 4; i < stem.size(); i += 3) {
      const double turn = 360 * hash01(id, std::uint32_t(100 + i)),
                   lift = 20 + 50 * hash01(id, std::uint32_t(300 + i));
      const double size = 0.030 + 0.020 * hash01(id, std::uint32_t(500 + i));
      model.add("leaves", "wood", leaf(2 * size, 1.1 * size, 0.5 * size),
                translate(stem[i]) * rotate(turn, {0, 1, 0}) * rotate(lift, {0, 0, 1}));
    }
  }
  return model;
}

}  // namespace nook::meshgen
