#include "room.hpp"

#include <algorithm>

#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace room {
namespace {

/// A profile of (distance from the wall, y), from top to bottom, led around the room with mitred corners.
Part moulding(const std::vector<dvec2>& profile) {
  return shaded(grid(int(profile.size()), 4,
                     [&](int row, int column) {
                       const dvec2 p = profile[std::size_t(row)];
                       const double x = half_x - p.x, z = half_z - p.x;
                       const dvec2 corners[] = {{x, z}, {x, -z}, {-x, -z}, {-x, z}};
                       return dvec3(corners[column].x, p.y, corners[column].y);
                     },
                     {.wrap = true}),
                20);
}

/// The wall x=-3 with the window's recess; all pieces share their vertices, so that nothing leaks.
Part window_wall() {
  const double ys[] = {0, 0.85, 2.15, height}, zs[] = {-half_z, -0.35, 1.05, half_z};
  Part part;
  std::uint32_t front[4][4], back[2][2];
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) front[i][k] = part.add({-half_x, ys[i], zs[k]});
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) back[i][k] = part.add({-half_x - 0.28, ys[i + 1], zs[k + 1]});
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (i != 1 || k != 1) part.quad(front[i][k], front[i + 1][k], front[i + 1][k + 1], front[i][k + 1]);
  part.quad(back[0][0], back[1][0], back[1][1], back[0][1]);
  part.quad(front[1][1], back[0][0], back[0][1], front[1][2]);  // sill
  part.quad(front[2][1], front[2][2], back[1][1], back[1][0]);
  part.quad(front[1][1], front[2][1], back[1][0], back[0][0]);
  part.quad(front[1][2], back[0][1], back[1][1], front[2][2]);
  return part;
}

void add_window(Model& model) {
  const double x = -half_x - 0.22, y0 = 0.85, y1 = 2.15, z0 = -0.35, z1 = 1.05;
  const double yc = 0.5 * (y0 + y1), zc = 0.5 * (z0 + z1), h = 0.5 * (y1 - y0), w = 0.5 * (z1 - z0);
  for (const double s : {-1.0, 1.0}) {
    model.add("window", "wood", rounded_box({0.035, 0.04, w}, 0.008),
              translate({x, yc + s * (h - 0.04), zc}));
    model.add("window", "wood", rounded_box({0.033, h - 0.002, 0.04}, 0.008),
              translate({x, yc, zc + s * (w - 0.04)}));
  }
  for (int i = 1; i < 4; ++i)
    model.add("window", "wood", rounded_box({0.022, h - 0.05, 0.014}, 0.006),
              translate({x, yc, z0 + i * 0.35}));
  for (int i = 1; i < 4; ++i)
    model.add("window", "wood", rounded_box({0.018, 0.012, w - 0.05}, 0.005),
              translate({x, y0 + i * 0.325, zc}));
  model.add("window", "wood", rounded_box({0.19, 0.018, w + 0.08}, 0.008),
            translate({-half_x - 0.10, y0, zc}));
}

}  // namespace

void add_shell(Model& model) {
  const double x = half_x, z = half_z;
  const auto flat = [](dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
    Part part;
    for (const dvec3& p : {a, b, c, d}) part.add(p);
    part.quad(0, 1, 2, 3);
    return part;
  };
  model.add("shell", "plaster", flat({-x, 0, z}, {x, 0, z}, {x, 0, -z}, {-x, 0, -z}));
  model.add("shell", "plaster", flat({-x, height, -z}, {x, height, -z}, {x, height, z}, {-x, height, z}));
  model.add("shell", "plaster", flat({-x, 0, -z}, {x, 0, -z}, {x, height, -z}, {-x, height, -z}));
  model.add("shell", "plaster", flat({x, 0, z}, {-x, 0, z}, {-x, height, z}, {x, height, z}));
  model.add("shell", "plaster", flat({x, 0, -z}, {x, 0, z}, {x, height, z}, {x, height, -z}));
  model.add("shell", "plaster", window_wall());
  add_window(model);

  model.add("mouldings", "plaster",
            moulding({{0.016, 0.145},
                      {0.022, 0.135},
                      {0.022, 0.125},
                      {0.030, 0.115},
                      {0.030, 0.03},
                      {0.036, 0.025},
                      {0.036, 0.004}}));
  model.add("mouldings", "plaster",
            moulding({{0.15, height - 0.001},
                      {0.15, height - 0.02},
                      {0.135, height - 0.03},
                      {0.115, height - 0.035},
                      {0.095, height - 0.05},
                      {0.08, height - 0.07},
                      {0.07, height - 0.09},
                      {0.045, height - 0.10},
                      {0.045, height - 0.115},
                      {0.02, height - 0.13},
                      {0.0, height - 0.135}}));
  // Beams under the ceiling, crossed by smaller ones.
  for (int i = 0; i < 5; ++i)
    model.add("beams", "wood", rounded_box({0.075, 0.085, half_z}, 0.012),
              translate({-2.4 + 1.2 * i, height - 0.085, 0}));
  for (int i = 0; i < 9; ++i)
    model.add("beams", "wood", rounded_box({half_x, 0.04, 0.035}, 0.008),
              translate({0, height - 0.04, -2.2 + 0.55 * i}));

  // Tiles of 25 cm with 4 mm joints, each a little higher or lower, none quite level.
  const Part tile = shaded(rounded_box({0.123, 0.010, 0.123}, 0.005, 2));
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 20; ++k) {
      const std::uint32_t id = std::uint32_t(24 * k + i);
      model.add("tiles", "tile", tile,
                translate({-2.875 + 0.25 * i, 0.0012 * (hash01(id, 1) - 0.5), -2.375 + 0.25 * k}) *
                    rotate(0.3 * (hash01(id, 2) - 0.5), {1, 0, 0}) *
                    rotate(0.3 * (hash01(id, 3) - 0.5), {0, 0, 1}));
    }
}

Part vessel(const std::vector<dvec2>& outline, double wall, int segments) {
  std::vector<dvec2> profile = {{0, outline.front().y}};
  profile.insert(profile.end(), outline.begin(), outline.end());
  const dvec2 rim = outline.back();
  profile.emplace_back(rim.x - 0.5 * wall, rim.y + 0.4 * wall);
  for (auto it = outline.rbegin(); it != outline.rend(); ++it)
    profile.emplace_back(std::max(it->x - wall, 0.3 * it->x),
                         std::max(it->y, outline.front().y + 1.5 * wall));
  profile.emplace_back(0, profile.back().y);
  return shaded(lathe(profile, segments), 50);
}

}  // namespace room

Model furnished_room() {
  Model model;
  model.material("plaster", -1);
  model.material("wood", 30);
  model.material("tile", 150);
  model.material("paper", -1);
  model.material("glazed", 400);
  model.material("metal", 300);
  model.material("cloth", -1);
  model.material("leaf", 40);
  room::add_shell(model);
  room::add_bookcase(model);
  room::add_sideboard(model);
  room::add_dining(model);
  room::add_sofa(model);
  room::add_textiles(model);
  room::add_plants(model);
  room::add_fittings(model);
  return model;
}

}  // namespace nook::meshgen
