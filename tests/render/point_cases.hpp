#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "points/points.hpp"
#include "support/estimates.hpp"
#include "support/meshes.hpp"
#include "support/rendering.hpp"
#include "support/statistics.hpp"

namespace nook::test {

/// A scene of one effect; limit: 0 for none.
inline Scene scene_of(EffectKind kind, Sampling sampling, Sampler sampler, float limit, float exponent = 0) {
  Scene scene;
  scene.sampler = sampler;
  scene.seed = test_seed(51);
  scene.spp = 1;
  Effect effect;
  effect.kind = kind;
  effect.sampling = sampling;
  effect.exponent = exponent;
  if (limit > 0)
    effect.max_distance = {DistanceLimit::Kind::value, limit};
  else
    effect.max_distance.kind = DistanceLimit::Kind::none;
  scene.effects = {effect};
  return scene;
}

/// A mesh about a receiver at the origin with normal +z that stands on a floor; `value` is its AO.
struct PolygonCase {
  std::string name;
  TriangleMesh mesh;
  float limit;  // 0: none
  double value;
};

inline std::vector<PolygonCase> polygon_cases() {
  std::vector<PolygonCase> cases;
  auto add = [&](const std::string& name, float limit, double value) -> TriangleMesh& {
    cases.push_back({name, {}, limit, value});
    add_quad(cases.back().mesh, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    return cases.back().mesh;
  };
  add_quad(add("wall 2 x 1 at distance 1/2", 0, 0.7514621801700255), {0.5f, -1, 0}, {0.5f, 1, 0},
           {0.5f, 1, 1}, {0.5f, -1, 1});
  add_quad(add("square overhead", 0, 0.7605435295392265), {-0.5f, -0.5f, 1}, {0.5f, -0.5f, 1},
           {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 1});
  TriangleMesh& cube = add("cube without a lid", 0, 0.2394564704607735);
  for (float side : {-0.5f, 0.5f}) {
    add_quad(cube, {side, -0.5f, 0}, {side, 0.5f, 0}, {side, 0.5f, 1}, {side, -0.5f, 1});
    add_quad(cube, {-0.5f, side, 0}, {0.5f, side, 0}, {0.5f, side, 1}, {-0.5f, side, 1});
  }
  // Within the limit 2 the ceiling at 1 is a disk of radius sqrt(3): its corners do not matter.
  add_quad(add("ceiling, limit 2", 2, 0.25), {-2, -2, 1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, 1});
  return cases;
}

/// The mean of a film of independent estimates is `expected`, within `bound` standard errors.
inline void expect_mean(const Film& film, double expected, double bound, const std::string& what) {
  std::vector<double> values;
  for (std::size_t i = 0; i < film.pixels(); ++i) values.push_back(film.value(i));
  Moments m = moments(std::span<const double>(values));
  EXPECT_LE(std::abs(m.mean - expected), bound * m.mean_error + 1e-6)
      << what << ": " << m.mean << " for " << expected << ", standard error " << m.mean_error;
}

}  // namespace nook::test
