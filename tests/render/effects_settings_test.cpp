// What an effect's settings mean, against closed forms. Receiver at the origin, normal +z. Under an endless
// ceiling at height h, a direction at cosine m to the normal meets it at t = h/m; with c = h/R (R the
// distance limit) cosine-weighted values are integrals over 2 m dm, and the directions with m < c are open.
#include <gtest/gtest.h>

#include <numbers>

#include "effects_geometry.hpp"
#include "mesh/instance.hpp"
#include "support/expect_error.hpp"

namespace nook::test {
namespace {

constexpr double c = 0.5;  // h = 1, R = 2

Effect ao_within(float distance) {
  Effect effect;
  effect.max_distance = {DistanceLimit::Kind::value, distance};
  return effect;
}

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

TEST(EffectSettings, NoFalloffIsTheOpenShare) {
  expect_value(estimate_at_origin(plane_at(1), ao_within(2)), c * c);
}

// V = s = c/m: c² + 2 c (1 - c).
TEST(EffectSettings, LinearFalloff) {
  EXPECT_NEAR(under_ceiling([](double s) { return s; }), 2 * c - c * c, 1e-9);
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::linear)), 2 * c - c * c);
}

// V = s²(3-2s): 4c³ - 3c² - 6c² ln c.
TEST(EffectSettings, SmoothFalloff) {
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::smooth)),
               4 * c * c * c - 3 * c * c - 6 * c * c * std::log(c));
}

TEST(EffectSettings, ExponentialFalloff) {
  const auto visibility = [](double s) { return std::expm1(-4 * s) / std::expm1(-4.0); };
  expect_value(estimate_at_origin(plane_at(1), with_falloff(Falloff::exponential)),
               under_ceiling(visibility));
}

// The ceiling counts from t = 1.25 to 2, that is m from 0.5 to 0.8: 1 - (0.64 - 0.25).
TEST(EffectSettings, NearerThanTheLeastDistanceDoesNotCount) {
  Effect effect = ao_within(2);
  effect.min_distance = 1.25f;
  expect_value(estimate_at_origin(plane_at(1), effect), 0.61);
}

// With falloff too: the hidden directions have V = c/m: 1 - (0.64 - 0.25) + integral of 2 m c/m from 0.5 to
// 0.8 = 0.61 + 0.3.
TEST(EffectSettings, LeastDistanceWithFalloff) {
  Effect effect = with_falloff(Falloff::linear);
  effect.min_distance = 1.25f;
  expect_value(estimate_at_origin(plane_at(1), effect), 0.91);
}

// In the cone of half-angle a, the open m go from cos a to c: (c² - cos² a) / sin² a; at 45 degrees none.
TEST(EffectSettings, ConeOfDirections) {
  for (const Sampling sampling : {Sampling::cosine, Sampling::hemisphere}) {
    Effect effect = ao_within(2);
    effect.sampling = sampling;
    effect.cone_angle = 75;
    const double cos2 = std::pow(std::cos(75 * M_PI / 180), 2);
    expect_value(estimate_at_origin(plane_at(1), effect), (c * c - cos2) / (1 - cos2));
    effect.cone_angle = 45;
    EXPECT_EQ(estimate_at_origin(plane_at(1), effect).value(0), 0);
    EXPECT_NEAR(estimate_at_origin(plane_at(3), effect).value(0), 1,
                sampling == Sampling::cosine ? 0 : 0.005);
  }
}

// A slab of thickness 1 under the receiver: looking inside is looking at a ceiling; the outside is open.
TEST(EffectSettings, InsideLooksTheOtherWay) {
  TriangleMesh slab = plane_at(0);
  const TriangleMesh bottom = plane_at(-1);
  add_quad(slab, bottom.positions[0], bottom.positions[1] - bottom.positions[0],
           bottom.positions[3] - bottom.positions[0]);
  Effect effect = ao_within(2);
  EXPECT_EQ(estimate_at_origin(slab, effect).value(0), 1);
  effect.side = Side::inside;
  expect_value(estimate_at_origin(slab, effect), c * c);
}

// What camera rays find, too: from above, the slab's inside is the same everywhere.
TEST(EffectSettings, InsideOfASlabUnderTheCamera) {
  TriangleMesh slab = plane_at(0);
  add_quad(slab, {-1000, -1000, -1}, {2000, 0, 0}, {0, 2000, 0});
  Scene scene;
  scene.camera = {{0.3f, 0.4f, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.width = scene.height = 16;
  scene.spp = 64;
  scene.effects = {ao_within(2)};
  scene.effects[0].side = Side::inside;
  const Plan plan = make_plan(scene, slab);
  const Bvh bvh = build_bvh(slab);
  OcclusionTracer tracer(device(), plan, slab, bvh);
  std::vector<Film> films = tracer.make_films();
  tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, scene.spp}, films);
  double mean = 0;
  for (std::size_t i = 0; i < films[0].pixels(); ++i) mean += films[0].value(i) / double(films[0].pixels());
  EXPECT_NEAR(mean, c * c, 4 * std::sqrt(0.1875 / (256 * 64)));
}

// A plane with its normal upwards, a ceiling above it, the camera below: the normal's side is half hidden,
// the viewer's is open.
// A ground one below a point of a wall: directions with d.y < -1/R meet it within R, of the disc that
// cosine-weighted directions fill a segment of (arccos c - c sqrt(1 - c²)) / π; without a limit it is half of
// the disc.
TEST(EffectSettings, GroundUnderAWall) {
  TriangleMesh wall;
  add_quad(wall, {-0.01f, -0.01f, -1}, {0.02f, 0, 0}, {0, 0.02f, 0});
  append_ground(wall, -1, 1000);
  expect_value(estimate_at_origin(wall, ao_within(2)),
               1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / std::numbers::pi);
  Effect endless;
  endless.max_distance = {DistanceLimit::Kind::none, 0};
  expect_value(estimate_at_origin(wall, endless), 0.5);
}

TEST(EffectSettings, ViewersSide) {
  TriangleMesh mesh = plane_at(0);
  add_quad(mesh, {-1000, -1000, 1}, {2000, 0, 0}, {0, 2000, 0});
  Scene scene;
  scene.camera = {{0.3f, 0.4f, -5}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.width = scene.height = 8;
  scene.spp = 64;
  scene.effects = {ao_within(2), ao_within(2)};
  scene.effects[1].side = Side::viewer;
  const Plan plan = make_plan(scene, mesh);
  const Bvh bvh = build_bvh(mesh);
  OcclusionTracer tracer(device(), plan, mesh, bvh);
  std::vector<Film> films = tracer.make_films();
  tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, scene.spp}, films);
  double mean = 0;
  for (std::size_t i = 0; i < films[0].pixels(); ++i) {
    mean += films[0].value(i) / double(films[0].pixels());
    EXPECT_EQ(films[1].value(i), 1);
  }
  EXPECT_NEAR(mean, c * c, 4 * std::sqrt(0.1875 / (64 * 64)));
}

TEST(EffectSettings, ContradictionsAreRefused) {
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
