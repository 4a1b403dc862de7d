#include "primitives.hpp"
#include "spaceship.hpp"

namespace nook::meshgen::ship {
namespace {

Part rod(const dvec3& a, const dvec3& b, double radius, int sides = 20) {
  return tube({a, b}, radius, sides);
}

/// One leg: a telescopic strut that leans, a brace, a hose, a ribbed pad. `foot` is on the ground, `top`
/// inside the hull.
void add_leg(Model& model, const dvec3& foot, const dvec3& top, const dvec3& brace) {
  const dvec3 ankle = foot + dvec3(0, 0.075, 0), axis = top - ankle;
  const dvec3 knee = ankle + 0.42 * axis;
  model.add("gear", "engine", rod(ankle, knee + 0.1 * axis, 0.021, 28));
  model.add("gear", "engine", rod(knee, top, 0.036, 32));
  for (const double t : {0.0, 0.06, 0.30})
    model.add("gear", "engine", torus(0.038, 0.008, 36, 10), frame(knee + t * axis, axis, {1, 0, 0}));
  model.add("gear", "engine", rod(ankle + 0.30 * axis, brace, 0.015));
  model.add("gear", "engine",
            rod(ankle + 0.55 * axis + dvec3(0, 0, 0.03), brace + dvec3(0, 0, 0.03), 0.008, 12));
  model.add("gear", "engine", sphere(0.030, 32, 16), translate(ankle));
  const dvec3 side = glm::normalize(glm::cross(axis, brace - knee));
  model.add("hoses", "engine",
            tube(spline({ankle + 0.02 * side + dvec3(0.02, 0, 0), ankle + 0.15 * axis + 0.055 * side,
                         knee + 0.045 * side, knee + 0.25 * axis + 0.055 * side, top},
                        10),
                 0.006, 10));
  // The pad: a dish with radial ribs on a bevelled plate.
  const dmat4 at = translate(foot);
  model.add("gear_pads", "engine",
            lathe({{0, 0},
                   {0.118, 0},
                   {0.126, 0.006},
                   {0.126, 0.020},
                   {0.118, 0.027},
                   {0.095, 0.027},
                   {0.085, 0.032},
                   {0.045, 0.050},
                   {0.036, 0.062},
                   {0.030, 0.075},
                   {0, 0.075}},
                  72),
            at);
  for (int i = 0; i < 12; ++i) {
    model.add("gear_pads", "engine", rounded_box({0.036, 0.010, 0.005}, 0.002, 1),
              at * rotate(30.0 * i, {0, 1, 0}) * translate({0.078, 0.036, 0}) * rotate(-22, {0, 0, 1}));
    model.add("bolts", "engine", cylinder(0.006, 0.008, 6, 0.0015),
              at * rotate(30.0 * i + 15, {0, 1, 0}) * translate({0.107, 0.026, 0}));
  }
}

}  // namespace

void add_landing_gear(Model& model) {
  add_leg(model, {1.12, 0, 0}, {1.02, 0.56, 0}, {0.76, 0.47, 0});
  for (const double side : {1.0, -1.0}) {
    add_leg(model, {-0.72, 0, 0.56 * side}, {-0.68, 0.62, 0.44 * side}, {-0.36, 0.56, 0.42 * side});
    // Doors hang open on both sides of each well.
    for (const double along : {0.11, -0.20})
      model.add(
          "gear_doors", "hull", rounded_box({0.008, 0.085, 0.12}, 0.006, 2),
          translate({-0.58 + along * 1.2, 0.47, 0.50 * side}) * rotate(along > 0 ? 14 : -14, {0, 0, 1}));
    model.add("gear_doors", "hull", rounded_box({0.17, 0.075, 0.007}, 0.005, 2),
              translate({0.96, 0.385, 0.105 * side}) * rotate(-16 * side, {1, 0, 0}));
  }
}

}  // namespace nook::meshgen::ship
