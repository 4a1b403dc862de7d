// How distance counts: limit, falloff, least distance, against closed forms. Receiver at the origin, normal
// +z. Under an endless ceiling at height h, a direction at cosine m to the normal meets it at t = h/m; with c
// = h/R (R the distance limit) cosine-weighted values are integrals over 2 m dm, and the directions with m <
// c are open.
#include <gtest/gtest.h>

#include "effects_geometry.hpp"
#include "support/expect_error.hpp"

namespace nook::test {
namespace {

constexpr double c = 0.5;  // h = 1, R = 2

Effect with_falloff(Falloff falloff) {
  Effect effect = ao_within(2);
  effect.falloff = falloff;
  return effect;
}

// Simpson's rule for c² + the integral of 2 m V(c/m) from c to 1.
template <class V>
double under_ceiling(V visibility) {
  const int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double m = c + (1 - c) * i / steps, weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
    sum += weight * 2 * m * visibility(c / m);
  }
  return c * c + sum * (1 - c) / steps / 3;
}

TEST(Visibility, NoFalloffIsTheOpenShare) {
  expect_value(estimate_at_origin(plane_at(1), ao_within(2)), c * c);
}

// V = s = c/m: c² + 2 c (1 - c).
TEST(Visibility, LinearFalloff) {
  EXPECT_NEAR(under_ceiling([](double s) { return s; }), 2 * c - c * c, 1e-9);
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::linear)), 2 * c - c * c);
}

// V = s²(3-2s): 4c³ - 3c² - 6c² ln c.
TEST(Visibility, SmoothFalloff) {
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::smooth)),
               4 * c * c * c - 3 * c * c - 6 * c * c * std::log(c));
}

TEST(Visibility, ExponentialFalloff) {
  const auto visibility = [](double s) { return std::expm1(-4 * s) / std::expm1(-4.0); };
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::exponential)),
               under_ceiling(visibility));
}

// The ceiling counts from t = 1.25 to 2, that is m from 0.5 to 0.8: 1 - (0.64 - 0.25).
TEST(Visibility, NearerThanTheLeastDistanceDoesNotCount) {
  Effect effect = ao_within(2);
  effect.min_distance = 1.25f;
  expect_value(estimate_at_origin(plane_at(1), effect), 0.61);
}

// With falloff too: the hidden directions have V = c/m: 1 - (0.64 - 0.25) + integral of 2 m c/m from 0.5 to
// 0.8 = 0.61 + 0.3.
TEST(Visibility, LeastDistanceWithFalloff) {
  Effect effect = with_falloff(Falloff::linear);
  effect.min_distance = 1.25f;
  expect_value(estimate_at_origin(plane_at(1), effect), 0.91);
}

TEST(Visibility, ContradictionsAreRefused) {
  const TriangleMesh mesh = plane_at(1);
  const auto refuse = [&](const std::string& message, auto change) {
    Scene scene;
    scene.file = "scene.toml";
    scene.effects = {ao_within(2)};
    change(scene.effects[0]);
    expect_error(ErrorKind::scene, "scene.toml: " + message, [&] { make_plan(scene, mesh); });
  };
  refuse("falloff = \"linear\" needs a max_distance", [](Effect& e) {
    e.falloff = Falloff::linear;
    e.max_distance.kind = DistanceLimit::Kind::none;
  });
  refuse("min_distance must be below max_distance", [](Effect& e) { e.min_distance = 2; });
  refuse("cone_angle needs sampling_type cosine or hemisphere", [](Effect& e) {
    e.cone_angle = 30;
    e.sampling = Sampling::sphere;
  });
}

}  // namespace
}  // namespace nook::test
