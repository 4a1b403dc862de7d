#include "models.hpp"
#include "primitives.hpp"

namespace nook::meshgen {
namespace {

Part wall(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
  Part part;
  for (const dvec3& p : {a, b, c, d}) part.add(p);
  part.quad(0, 1, 2, 3);
  return shaded(part, 5);  // the left wall is not quite planar
}

}  // namespace

Model cornell_box() {
  // The corners as measured at Cornell and scaled by the course: the box is not a perfect cuboid.
  constexpr double front = 0.99, back = -1.04, top = 1.59, right = 1.004078;
  const dvec3 left_floor_front(-1.005922, 0, front), left_floor_back(-0.985922, 0, back);
  const dvec3 left_top_front(-1.015922, top, front), left_top_back(-1.015922, top, back);
  const dvec3 right_floor_front(right, 0, front), right_floor_back(right, 0, back);
  const dvec3 right_top_front(right, top, front), right_top_back(right, top, back);

  Model model;
  model.material("wall", -1);
  model.material("sphere", 300);
  model.add("floor", "wall", wall(left_floor_front, right_floor_front, right_floor_back, left_floor_back));
  model.add("ceiling", "wall", wall(left_top_front, left_top_back, right_top_back, right_top_front));
  model.add("back", "wall", wall(left_floor_back, right_floor_back, right_top_back, left_top_back));
  model.add("left", "wall", wall(left_floor_front, left_floor_back, left_top_back, left_top_front));
  model.add("right", "wall", wall(right_floor_back, right_floor_front, right_top_front, right_top_back));
  const Part ball = shaded(sphere(0.33, 96, 48), 180);
  model.add("sphere_right", "sphere", ball, translate({0.444075, 0.33, 0.38}));
  model.add("sphere_left", "sphere", ball, translate({-0.4173, 0.33, -0.28}));
  return model;
}

}  // namespace nook::meshgen
