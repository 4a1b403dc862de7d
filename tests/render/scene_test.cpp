// The scenes that nook ships, at reduced size: all estimators of an effect agree with one reference from
// Embree (other warps, other random numbers, other intersection code), and the Cornell box has the means that
// the course's images have.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "mesh/obj_loader.hpp"
#include "scene/scene_toml.hpp"
#include "support/estimates.hpp"
#include "support/image_comparison.hpp"
#include "support/rendering.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

// Empty if the scene's mesh has not been generated (NOOK_SCENES=OFF, or Debian's bunny is missing).
std::optional<Scene> shipped_scene(const std::string& name) {
  Scene scene = load_scene(std::string(NOOK_SOURCE_DIR) + "/scenes/" + name + ".toml");
  if (!std::filesystem::exists(scene.mesh_file)) return std::nullopt;
  scene.sampler = Sampler::independent;
  scene.width = 64;
  scene.height = 48;
  scene.spp = 128;
  scene.directions = 1;
  scene.seed = test_seed(71);
  return scene;
}

void expect_agreement(const Scene& scene, const TriangleMesh& mesh, const ReferenceImage& reference,
                      const std::string& name) {
  Renderer renderer(scene, mesh);
  ReferenceImage image = renderer.picture();
  ImageVerdict v = compare_with_evidence(image, reference, false, name);
  EXPECT_TRUE(v.tiles_agree && v.image_agrees)
      << name << ": by tile " << v.tile_p << ", of the image " << v.image_p;
  EXPECT_EQ(renderer.counters().rejected, 0u) << name;
}

class ShippedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, AllEstimatorsAgreeWithEmbree) {
  std::optional<Scene> scene = shipped_scene(GetParam());
  if (!scene) GTEST_SKIP() << "scenes/" << GetParam() << ".toml: its mesh has not been generated";
  TriangleMesh mesh = load_obj(scene->mesh_file);
  OracleTracer embree = embree_robust(mesh);

  Effect& effect = scene->effects.front();
  effect.kind = EffectKind::ao;
  double limit = 0.5 * double(mesh.bounds.bounding_radius());
  effect.max_distance = {DistanceLimit::Kind::value, float(limit)};
  ReferenceImage ambient = reference_image(*scene, mesh, embree, limit, 512, 811);
  for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    effect.sampling = sampling;
    expect_agreement(*scene, mesh, ambient, GetParam() + "_ao_" + name_of(sampling));
  }

  effect.kind = EffectKind::ro;
  effect.exponent = 5;
  effect.max_distance = {DistanceLimit::Kind::none, 0};
  ReferenceImage reflection =
      reference_image(*scene, mesh, embree, std::numeric_limits<double>::infinity(), 512, 812);
  for (Sampling sampling :
       {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    effect.sampling = sampling;
    expect_agreement(*scene, mesh, reflection, GetParam() + "_ro_" + name_of(sampling));
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names{"cbox_ao_cosine", "fence_ao", "bunny_ao"};
  if (long_mode())
    names.insert(names.end(), {"spaceship_ao_cosine", "room_ao"});  // their meshes take seconds to load
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, ::testing::ValuesIn(scene_names()),
                         [](const auto& name) { return name.param; });

double mean_of(const ReferenceImage& image) {
  double sum = 0;
  for (double value : image.mean) {
    EXPECT_TRUE(std::isfinite(value));
    sum += value;
  }
  return sum / double(image.mean.size());
}

// Means of the published images: RO at exponent 300 with unlimited rays 0.1495; AO with the limit 1.5 that
// they have 0.457.
TEST(Cornell, HasThePublishedMeans) {
  std::optional<Scene> scene = shipped_scene("cbox_ro");
  if (!scene) GTEST_SKIP() << "scenes/cbox_ro.toml: its mesh has not been generated";
  scene->sampler = Sampler::sobol;
  scene->width = 200;
  scene->height = 150;
  scene->spp = 32;
  TriangleMesh mesh = load_obj(scene->mesh_file);
  ASSERT_EQ(scene->effects.front().exponent, 300);
  EXPECT_NEAR(mean_of(Renderer(*scene, mesh).picture()), 0.1495, 0.002);
  scene->effects.front() = Effect();
  scene->compat_tinyrender = true;
  EXPECT_NEAR(mean_of(Renderer(*scene, mesh).picture()), 0.457, 0.003);
}

}  // namespace
}  // namespace nook::test
