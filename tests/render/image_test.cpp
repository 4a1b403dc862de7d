// Pictures against the oracle: double precision, every triangle, other random numbers, other warps. Each
// distribution, each sampler, and defects planted in the kernels that must not pass.
#include <gtest/gtest.h>

#include <cmath>

#include "support/estimates.hpp"
#include "support/image_comparison.hpp"
#include "support/meshes.hpp"
#include "support/mutants.hpp"
#include "support/rendering.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

// Looks down into the courtyard: contacts, a slit between the boxes, grazing floor, sky.
Scene courtyard_scene(EffectKind kind, Sampling sampling, Sampler sampler = Sampler::independent) {
  Scene scene;
  scene.camera = {{0.6f, -3.2f, 1.9f}, {0.1f, 0.4f, 0.4f}, {0, 0, 1}, 45};
  scene.width = 48;
  scene.height = 32;
  scene.spp = 256;
  scene.sampler = sampler;
  scene.seed = test_seed(41);
  Effect effect;
  effect.kind = kind;
  effect.sampling = sampling;
  effect.exponent = 8;
  effect.max_distance = {DistanceLimit::Kind::value, 1.25f};
  scene.effects = {effect};
  return scene;
}

const TriangleMesh& courtyard_mesh() {
  static const TriangleMesh mesh = courtyard();
  return mesh;
}

const ReferenceImage& oracle_picture(EffectKind kind) {
  static const ReferenceImage ambient =
      reference_image(courtyard_scene(EffectKind::ao, Sampling::cosine), courtyard_mesh(),
                      brute_force(courtyard_mesh()), 1.25, 1024, 4711);
  static const ReferenceImage reflection =
      reference_image(courtyard_scene(EffectKind::ro, Sampling::lobe), courtyard_mesh(),
                      brute_force(courtyard_mesh()), 1.25, 1024, 4712);
  return kind == EffectKind::ao ? ambient : reflection;
}

void expect_agreement(const ReferenceImage& image, EffectKind kind, bool pooled, const std::string& name) {
  ImageVerdict v = compare_with_evidence(image, oracle_picture(kind), pooled, name);
  EXPECT_TRUE(v.agree()) << name << ": smallest p by pixel " << v.pixel_p << ", by tile " << v.tile_p
                         << ", of the image " << v.image_p;
}

TEST(Image, AmbientEqualsTheOracle) {
  for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    // Weights differ between distributions, so only the cosine's variance is the oracle's.
    bool pooled = sampling == Sampling::cosine;
    expect_agreement(Renderer(courtyard_scene(EffectKind::ao, sampling), courtyard_mesh()).picture(),
                     EffectKind::ao, pooled, "ao_" + name_of(sampling));
  }
}

TEST(Image, ReflectionEqualsTheOracle) {
  for (Sampling sampling : {Sampling::lobe, Sampling::mixture})
    expect_agreement(Renderer(courtyard_scene(EffectKind::ro, sampling), courtyard_mesh()).picture(),
                     EffectKind::ro, sampling == Sampling::lobe, "ro_" + name_of(sampling));
  // Distributions that seldom find the lobe: a pixel's mean of few large weights is far from normal, a tile's
  // is not.
  for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    ReferenceImage image = Renderer(courtyard_scene(EffectKind::ro, sampling), courtyard_mesh()).picture();
    ImageVerdict v =
        compare_with_evidence(image, oracle_picture(EffectKind::ro), false, "ro_" + name_of(sampling));
    EXPECT_TRUE(v.tiles_agree && v.image_agrees)
        << name_of(sampling) << ": by tile " << v.tile_p << ", of the image " << v.image_p;
  }
}

// Camera samples times directions must not change what is estimated.
TEST(Image, SeveralDirectionsPerCameraRay) {
  Scene scene = courtyard_scene(EffectKind::ao, Sampling::cosine);
  scene.spp = 64;
  scene.directions = 8;
  expect_agreement(Renderer(scene, courtyard_mesh()).picture(), EffectKind::ao, false, "ao_64x8");
}

// Point sets by 20 replicates of 16 camera samples.
TEST(Image, EverySamplerEqualsTheOracle) {
  for (Sampler sampler : {Sampler::stratified, Sampler::halton, Sampler::sobol, Sampler::zorder})
    for (EffectKind kind : {EffectKind::ao, EffectKind::ro}) {
      if (kind == EffectKind::ro && sampler != Sampler::sobol) continue;
      Scene scene =
          courtyard_scene(kind, kind == EffectKind::ao ? Sampling::cosine : Sampling::lobe, sampler);
      scene.spp = 16;
      ReferenceImage image = replicated_picture(scene, courtyard_mesh(), 20);
      ImageVerdict v =
          compare_with_evidence(image, oracle_picture(kind), false, "sampler_" + name_of(sampler));
      // Z-order's errors cancel between pixels, so its tiles scatter less than their pixels' variances say:
      // the test is then only more lenient. Pixels of 20 replicates can miss an event that the oracle saw
      // once in 1024 samples: their own spread says nothing about it, tiles and the image decide.
      EXPECT_TRUE(v.tiles_agree && v.image_agrees)
          << name_of(sampler) << ": by tile " << v.tile_p << ", of the image " << v.image_p;
    }
}

// The same defects that closed forms see, and those that need geometry.
TEST(ImageMutants, AreRejected) {
  struct Mutation {
    std::string name;
    EffectKind kind;
    Sampling sampling;
    std::string file, find, replace;
  };
  const Mutation mutations[] = {
      {"rays start 1e-2 off the surface", EffectKind::ao, Sampling::cosine, "stage/primary.cl",
       "9.536743e-7f * lesser(", "1e-2f * lesser("},
      {"flipped normal", EffectKind::ao, Sampling::cosine, "stage/primary.cl",
       "store3(out->normal, ray_direction(", "store3(out->normal, -ray_direction("},
      {"limit ignored", EffectKind::ao, Sampling::cosine, "stage/occlusion.cl",
       "p->max_distance - p->min_distance : p->max_distance;",
       "p->max_distance - p->min_distance : INFINITY;"},
      {"uniform directions weighted as cosine", EffectKind::ao, Sampling::cosine, "stage/occlusion.cl",
       "in_frame = square_to_cosine_hemisphere(u);\n    weight",
       "in_frame = square_to_hemisphere(u);\n    weight"},
      // |cos| for max(0, cos) is no defect that a picture of closed surfaces shows: directions under the
      // horizon end in the surface itself. Points without a surface show it (statistics/mutant_test.cpp).
      {"sphere weighted as hemisphere", EffectKind::ao, Sampling::sphere, "stage/occlusion.cl",
       "4.0f * fmax(0.0f, in_frame.z)", "2.0f * fmax(0.0f, in_frame.z)"},
      {"no foreshortening", EffectKind::ro, Sampling::lobe, "stage/occlusion.cl",
       "(exponent + 2.0f) / (exponent + 1.0f) * cosine", "(exponent + 2.0f) / (exponent + 1.0f)"},
      {"lobe about the view", EffectKind::ro, Sampling::lobe, "stage/occlusion.cl",
       "mirror_direction(normal, view)", "view"},
      {"brighter by 1 %", EffectKind::ro, Sampling::lobe, "stage/occlusion.cl",
       "(exponent + 2.0f) / (exponent + 1.0f) * cosine",
       "1.01f * (exponent + 2.0f) / (exponent + 1.0f) * cosine"}};
  for (const Mutation& m : mutations) {
    auto source = [&m](const std::string& file) {
      return file == m.file ? mutate(kernel_source(file), m.find, m.replace) : kernel_source(file);
    };
    Scene scene = courtyard_scene(m.kind, m.sampling);
    scene.spp = 1024;
    ImageVerdict v =
        compare(Renderer(scene, courtyard_mesh(), source).picture(), oracle_picture(m.kind), false);
    EXPECT_FALSE(v.agree()) << m.name << " survived: by pixel " << v.pixel_p << ", by tile " << v.tile_p
                            << ", of the image " << v.image_p;
  }
}

}  // namespace
}  // namespace nook::test
