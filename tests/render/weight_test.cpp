// weight = "uniform": the open share of the hemisphere's solid angle, 1/2π ∫ V dω, against closed forms.
// Receiver at the origin, normal +z. Under an endless ceiling at height h, a direction at cosine m meets it
// at t = h/m; with c = h/R (R the distance limit) the directions with m < c are open, and m is uniform in [0,
// 1].
#include <gtest/gtest.h>

#include <numbers>

#include "effects_geometry.hpp"
#include "film/bent_cone.hpp"
#include "scene/effect_keys.hpp"
#include "support/expect_error.hpp"
#include "support/mutants.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

constexpr double c = 0.5;  // h = 1, R = 2
constexpr Sampling possible[] = {Sampling::hemisphere, Sampling::sphere};

Effect uniform(EffectKind kind, Sampling sampling = Sampling::hemisphere) {
  Effect effect = default_effect(kind);
  effect.uniform_weight = true;
  effect.sampling = sampling;
  effect.max_distance = {DistanceLimit::Kind::value, 2};
  return effect;
}

TEST(UniformWeight, IsTheOpenShareOfTheSolidAngle) {
  for (const Sampling sampling : possible) {
    expect_value(estimate_at_origin(plane_at(1), uniform(EffectKind::ao, sampling)), c);
    expect_value(estimate_at_origin(plane_at(-1), uniform(EffectKind::ao, sampling)), 1);
  }
}

// A direction's weight is 1, or 2 on the upper half of the sphere: variances A - A² and 2A - A².
TEST(UniformWeight, HasTheVarianceThatItShould) {
  const std::uint32_t n = 1u << 16;
  for (const double open : {0.125, 0.5, 0.875})
    for (const Sampling sampling : possible) {
      Effect effect = uniform(EffectKind::ao, sampling);
      effect.max_distance.value = float(1 / open);
      const Film film = estimate_at_origin(plane_at(1), effect, n);
      const double second = sampling == Sampling::sphere ? 2 * open : open;
      EXPECT_NEAR(film.variance(0) * n, second - open * open, 0.03 * second)
          << open << " " << name_of(sampling);
    }
}

// c + ∫ c/m dm from c to 1 = c - c ln c.
TEST(UniformWeight, WithFalloff) {
  Effect effect = uniform(EffectKind::ao);
  effect.falloff = Falloff::linear;
  expect_value(estimate_at_origin(plane_at(1), effect), c - c * std::log(c));
}

// In the cone of half-angle a, the open m go from cos a to c: (c - cos a) / (1 - cos a).
TEST(UniformWeight, InACone) {
  Effect effect = uniform(EffectKind::ao);
  effect.cone_angle = 75;
  const double edge = std::cos(75 * std::numbers::pi / 180);
  expect_value(estimate_at_origin(plane_at(1), effect), (c - edge) / (1 - edge));
}

// The mean of the open directions: of a hemisphere |B| = 1/2, of a cone (1 + cos a)/2.
TEST(UniformWeight, BentNormalsAndTheirCones) {
  Effect effect = uniform(EffectKind::bent);
  const BentCone open = bent_cone(estimate_at_origin(plane_at(-1), effect), 0);
  EXPECT_GT(open.direction.z, 0.9999);
  EXPECT_GT(open.half_angle, 85);
  effect.cone_angle = 30;
  EXPECT_NEAR(bent_cone(estimate_at_origin(plane_at(-1), effect), 0).half_angle, 30, 0.5);
  // A wall x = 1 leaves the quarter x < 0: ∫ω over it is (-π/2, 0, π/2), of solid angle π.
  TriangleMesh wall;
  add_quad(wall, {1, -2000, 0}, {0, 4000, 0}, {0, 0, 2000});
  Effect beside = uniform(EffectKind::bent);
  beside.max_distance = {DistanceLimit::Kind::none, 0};
  const Film film = estimate_at_origin(wall, beside);
  const BentCone cone = bent_cone(film, 0);
  EXPECT_NEAR(film.value(0), 0.5, 0.01);
  EXPECT_NEAR(cone.direction.x, -std::sqrt(0.5), 0.01);
  EXPECT_NEAR(cone.direction.z, std::sqrt(0.5), 0.01);
  EXPECT_NEAR(cone.half_angle, std::acos(std::numbers::sqrt2 - 1) * 180 / std::numbers::pi, 1);
}

// The tests above see a weight that is not the one asked for.
TEST(UniformWeight, APlantedDefectIsSeen) {
  const auto mutant = [](const char* find, const char* replace) {
    return [=](const std::string& file) {
      const std::string source = kernel_source(file);
      return file.ends_with("occlusion.cl") ? mutate(source, find, replace) : source;
    };
  };
  const auto value_with = [&](const OcclusionTracer::KernelSource& source, Sampling sampling) {
    Scene scene;
    scene.effects = {uniform(EffectKind::ao, sampling)};
    scene.directions = 1u << 14;
    scene.sampler = Sampler::independent;
    const SurfacePoint point = surface_point({0, 0, 0}, {0, 0, 1}, {0, 0, 1});
    return Renderer(scene, plane_at(1), source)
        .tracer()
        .estimate_points({&point, 1}, 0, scene.directions)
        .value(0);
  };
  EXPECT_NEAR(value_with(kernel_source, Sampling::sphere), c, 0.03);
  EXPECT_GT(
      std::abs(value_with(mutant("WEIGHT == WEIGHT_UNIFORM ? 1.0f :", "0 ? 1.0f :"), Sampling::hemisphere) -
               c),
      0.2);
  EXPECT_GT(std::abs(value_with(mutant("in_frame.z > 0.0f ? 2.0f : 0.0f", "1.0f"), Sampling::sphere) - c),
            0.2);
}

TEST(UniformWeight, TheSceneAndItsFlags) {
  const TemporaryFolder folder;
  const auto scene =
      write_small_scene(folder, "scene.toml", "[renderer]\ntype = \"ao\"\nweight = \"uniform\"\nspp = 4\n");
  const auto sampling = [&](const std::string& more) {
    const ProgramResult run = run_nook(folder, "render '" + scene.string() + "' --print-config " + more);
    EXPECT_EQ(run.code, 0) << run.err;
    const std::size_t at = run.out.find("sampling_type = ");
    return at == std::string::npos ? "" : run.out.substr(at, run.out.find('\n', at) - at);
  };
  EXPECT_EQ(sampling(""), "sampling_type = \"hemisphere\"");
  EXPECT_EQ(sampling("--weight cosine"), "sampling_type = \"cosine\"");
  EXPECT_EQ(sampling("--sampling sphere"), "sampling_type = \"sphere\"");
  const ProgramResult refused = run_nook(folder, "render '" + scene.string() + "' --sampling cosine");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("\"uniform\" needs sampling_type hemisphere or sphere"), std::string::npos)
      << refused.err;
  // A bake has it too: each vertex of the floor's outer edge sees more of the solid angle than of the cosine.
  const ProgramResult baked =
      run_nook(folder, "bake '" + scene.string() + "' -o '" + (folder / "baked.ply").string() + "'");
  EXPECT_EQ(baked.code, 0) << baked.err;
}

}  // namespace
}  // namespace nook::test
