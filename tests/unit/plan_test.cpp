// What follows from a scene before anything is computed: layers, kernels, what is loaded, what is left out.
#include "plan/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bvh/bvh.hpp"
#include "mesh/obj_loader.hpp"
#include "plan/kernel_plan.hpp"
#include "plan/plan_report.hpp"
#include "plan/scene_camera.hpp"
#include "scene/scene_toml.hpp"
#include "support/expect_error.hpp"
#include "support/nook_program.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::TemporaryFolder;

struct Planned {
  Scene scene;
  TriangleMesh mesh;
  Plan plan;
};

Planned plan_of(const std::string& rest) {
  const TemporaryFolder folder;
  Planned result;
  result.scene = load_scene(test::write_small_scene(folder, "scene.toml", rest));
  validate(result.scene);
  result.mesh = load_obj(result.scene.mesh_file, needed_attributes(result.scene));
  result.plan = make_plan(result.scene, result.mesh);
  return result;
}

std::vector<std::string> prefixes(const Plan& plan) {
  std::vector<std::string> found;
  for (const LayerPlan& layer : plan.layers) found.push_back(layer.prefix);
  return found;
}

bool mentions(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

void expect_scene_error(const std::string& rest, const std::string& message) {
  expect_error(ErrorKind::scene, message, [&] { plan_of(rest); });
}

TEST(Plan, OneEffectIsRgb) {
  const Plan plan = plan_of("[renderer]\ntype = \"ao\"\nspp = 8\n").plan;
  ASSERT_EQ(plan.effects.size(), 1u);
  EXPECT_EQ(prefixes(plan), std::vector<std::string>{""});
  EXPECT_TRUE(plan.layers[0].main);
  EXPECT_FALSE(plan.surface);
  EXPECT_FALSE(plan.materials);
}

// A mesh without extent far from the origin: eye and center must not round to the same point.
TEST(Plan, FramesAPoint) {
  for (const float at : {0.0f, 1.0f, -1e6f, 1e-20f}) {
    TriangleMesh mesh;
    mesh.bounds.add(vec3(at, at, -at));
    const CameraParams camera = camera_params(scene_of_mesh("point.obj"), mesh);
    const dvec3 forward(camera.forward[0], camera.forward[1], camera.forward[2]),
        right(camera.right[0], camera.right[1], camera.right[2]);
    EXPECT_NEAR(glm::length(forward), 1, 1e-6) << at;
    EXPECT_NEAR(glm::length(right), 1, 1e-6) << at;
  }
}

TEST(Plan, LayersAreNamedByNameOrType) {
  const Plan plan = plan_of(R"([renderer]
spp = 2
[[effect]]
type = "ao"
[[effect]]
type = "ao"
name = "ro"
[[effect]]
type = "ro"
[[effect]]
type = "ro"
[[effect]]
type = "depth"
)")
                        .plan;
  EXPECT_EQ(prefixes(plan), (std::vector<std::string>{"", "ro.", "ro2.", "ro3.", "depth."}));
  EXPECT_EQ(plan.effects.size(), 4u);
  EXPECT_TRUE(plan.surface);
}

// R, G, B is what every viewer shows: the first layer by rays, SSAO only if there is nothing else.
TEST(Plan, SsaoIsTheMainLayerOnlyAlone) {
  const Plan both = plan_of("[[effect]]\ntype = \"ssao\"\n[[effect]]\ntype = \"ao\"\n").plan;
  EXPECT_EQ(prefixes(both), (std::vector<std::string>{"ssao.", ""}));
  EXPECT_FALSE(both.layers[0].main);
  EXPECT_TRUE(both.layers[1].main);
  const Plan alone = plan_of("[renderer]\nrealtime = true\ntype = \"ssao\"\n").plan;
  EXPECT_TRUE(alone.layers[0].main);
  EXPECT_EQ(prefixes(alone), std::vector<std::string>{""});
}

// The plain AO kernel does not know what else is asked for.
TEST(Plan, OtherEffectsLeaveAKernelAsItIs) {
  const Plan alone = plan_of("[renderer]\ntype = \"ao\"\nspp = 4\n").plan;
  const KernelPlan plain = occlusion_kernel(alone, alone.effects[0]);
  EXPECT_EQ(plain.options.text(), " -DEFFECT=0 -DSAMPLING=0 -DSAMPLER=3 -DREPLICATE_DIRECTIONS=0");
  const Plan many = plan_of(R"([renderer]
spp = 4
[[effect]]
type = "ao"
[[effect]]
type = "ro"
exponent = "material"
[[effect]]
type = "normal"
[[effect]]
type = "ssao"
)")
                        .plan;
  const KernelPlan among = occlusion_kernel(many, many.effects[0]);
  EXPECT_EQ(among.options.text(), plain.options.text());
  EXPECT_EQ(among.file, plain.file);
}

TEST(Plan, LoadsOnlyWhatEffectsRead) {
  const Planned ao = plan_of("[renderer]\ntype = \"ao\"\n");
  EXPECT_TRUE(ao.mesh.materials.empty());
  EXPECT_TRUE(ao.mesh.triangle_material.empty());
  EXPECT_TRUE(ao.mesh.triangle_group.empty());
  EXPECT_TRUE(ao.mesh.uvs.empty());
  EXPECT_FALSE(needed_attributes(plan_of("[renderer]\ntype = \"depth\"\n").scene).normals);
  const Planned lobes = plan_of("[renderer]\ntype = \"ro\"\nexponent = \"material\"\n");
  EXPECT_EQ(lobes.plan.exponents, (std::vector<float>{-1, 20}));
  EXPECT_EQ(lobes.mesh.triangle_material.size(), lobes.mesh.triangles.size());
}

TEST(Plan, ReportsWhatIsLeftOut) {
  const Planned ssao = plan_of("[renderer]\nrealtime = true\ntype = \"ssao\"\n");
  EXPECT_FALSE(ssao.plan.needs_opencl());
  const PlanReport screen = report_plan(ssao.scene, ssao.plan, ssao.mesh, nullptr);
  EXPECT_TRUE(mentions(screen.left_out, "no OpenCL, no kernels, no tree"));
  EXPECT_TRUE(screen.kernels.empty());
  EXPECT_TRUE(screen.buffers.empty());
  EXPECT_EQ(screen.libraries, std::vector<std::string>{"OSMesa"});

  const Planned ro = plan_of("[renderer]\ntype = \"ro\"\nexponent = \"material\"\nspp = 4\n");
  const Bvh bvh = build_bvh(ro.mesh);
  const PlanReport traced = report_plan(ro.scene, ro.plan, ro.mesh, &bvh);
  EXPECT_TRUE(mentions(traced.left_out, "no RO rays for material plain: no lobe"));
  EXPECT_TRUE(mentions(traced.left_out, "no vertex normals: the mesh has none"));
  EXPECT_TRUE(mentions(traced.left_out, "no OpenGL"));
  EXPECT_FALSE(mentions(traced.left_out, "no materials"));
  EXPECT_EQ(traced.kernels.size(), 2u);
  EXPECT_EQ(traced.passes[1].rays, 48u * 36 * 4);
}

TEST(Plan, BadEffectListsSayWhere) {
  const std::string list = "[[effect]]\ntype = \"ao\"\n";
  expect_scene_error("[renderer]\ntype = \"ao\"\n" + list,
                     "type belongs into the [[effect]] tables of this scene");
  expect_scene_error("[[effect]]\nname = \"x\"\n", "type is missing in [[effect]]");
  expect_scene_error("[[effect]]\ntype = \"aoo\"\n",
                     "scene.toml:12:8: unknown type 'aoo', did you mean 'ao'?");
  expect_scene_error(list + "exponent = 3\n", "unknown key 'exponent' in [[effect]] of type \"ao\"");
  expect_scene_error(list + "exponent = 3\n", ": it is one of type ro");
  expect_scene_error(list + "sampling_type = \"lobe\"\n", "needs type \"ro\"");
  expect_scene_error("[[effect]]\ntype = \"bent\"\nsampling_type = \"sphere\"\ncone_angle = 30\n",
                     "cone_angle needs sampling_type cosine or hemisphere");
  expect_scene_error(list + "name = \"N\"\n", "the name 'N' is taken");
  expect_scene_error(list + "name = \"a b\"\n", "name must be 1 to 64 of the letters");
  expect_scene_error(list + "name = \"a\"\n" + list + "name = \"a\"\n", "two effects are named 'a'");
  expect_scene_error("effect = 3\n", "unknown key 'effect' in [film]");
  expect_scene_error("[effect]\ntype = \"ao\"\n", "effects are tables: [[effect]]");
}

// TinyRender's keys of other types have no effect.
TEST(Plan, AnExponentBesideAoHasNoEffect) {
  const Plan plan = plan_of("[renderer]\ntype = \"ao\"\nexponent = \"material\"\n").plan;
  EXPECT_TRUE(plan.exponents.empty());
  EXPECT_FALSE(plan.materials);
}

TEST(Plan, ALobeByMaterialNeedsOne) {
  const TemporaryFolder folder;
  const auto file =
      test::write_small_scene(folder, "scene.toml", "[renderer]\ntype = \"ro\"\nexponent = \"material\"\n");
  const Scene scene = load_scene(file);
  const auto plan = [&] { return make_plan(scene, load_obj(scene.mesh_file, needed_attributes(scene))); };
  test::write_bytes(folder / "small.mtl", "newmtl plain\nnewmtl glossy\nKs 0 0 0\nNs 20\n");
  expect_error(ErrorKind::scene, "needs a material with a lobe", plan);
  test::write_bytes(folder / "small.mtl", "newmtl plain\nNs shiny\n");
  expect_error(ErrorKind::scene, "small.mtl:2: Ns must be a number from 0 to 1e7", plan);
  std::filesystem::remove(folder / "small.mtl");
  expect_error(ErrorKind::scene, "needs a material with a lobe", plan);
}

// Names in the scene and numbers of types may meet; each layer still has its own.
TEST(Plan, LayersHaveNamesOfTheirOwn) {
  const Plan plan =
      plan_of(
          "[renderer]\n[[effect]]\ntype = \"ao\"\n[[effect]]\ntype = \"ao\"\n[[effect]]\nname = "
          "\"ao2\"\ntype = \"ao\"\n[[effect]]\ntype = \"ao\"\n")
          .plan;
  EXPECT_EQ(prefixes(plan), (std::vector<std::string>{"", "ao.", "ao2.", "ao3."}));
}

// It was cubic: two thousand effects took twenty seconds.
TEST(Plan, TakesTimeInProportionToItsEffects) {
  std::string text = "[renderer]\n";
  for (int i = 0; i < 20000; ++i) text += "[[effect]]\ntype = \"ao\"\n";
  const auto start = std::chrono::steady_clock::now();
  const Planned many = plan_of(text);
  const PlanReport report = report_plan(many.scene, many.plan, many.mesh, nullptr);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_LT(taken.count(), 10);
  EXPECT_EQ(many.plan.layers.back().prefix, "ao19999.");
  EXPECT_EQ(report.kernels.size(), 2u) << "one for camera rays, one for all effects";
}

TEST(Plan, OfSsaoAloneHasNoCameraRays) {
  const TemporaryFolder folder;
  const auto scene =
      test::write_small_scene(folder, "scene.toml", "[renderer]\nrealtime = true\ntype = \"ssao\"\n");
  const test::ProgramResult run = test::run_nook(folder, "plan '" + scene.string() + "'");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out.find("camera ray"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("48x36 pixels, 14 triangles\n"), std::string::npos) << run.out;
}

TEST(Plan, OneIsSingular) {
  const TemporaryFolder folder;
  const auto scene = test::write_small_scene(folder, "scene.toml", "[renderer]\ntype = \"ao\"\nspp = 1\n");
  const test::ProgramResult run =
      test::run_nook(folder, "plan '" + scene.string() + "' --spp 1 --directions 1");
  EXPECT_NE(run.out.find("48x36 pixels, 1 camera ray a pixel, 1 direction each, 14 triangles\n"),
            std::string::npos)
      << run.out;
}

}  // namespace
}  // namespace nook
