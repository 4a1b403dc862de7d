// Sets of occluders and receivers against their oracle: the scene without the other triangles, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include <functional>
#include <nlohmann/json.hpp>

#include "effects_geometry.hpp"
#include "mesh/instance.hpp"
#include "mesh/obj_loader.hpp"
#include "plan/scene_mesh.hpp"
#include "points/points.hpp"
#include "points/vertex_points.hpp"
#include "scene/scene_toml.hpp"
#include "support/expect_error.hpp"
#include "support/kernels.hpp"
#include "support/nook_program.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {
namespace {

constexpr std::uint32_t directions = 256;
constexpr MeshAttributes everything{.normals = true, .uvs = false, .materials = true, .groups = true};

TriangleMesh small_mesh() {
  const TemporaryFolder folder;
  write_bytes(folder / "small.obj", small_obj);
  write_bytes(folder / "small.mtl", small_mtl);
  return load_obj(folder / "small.obj", everything);
}

// The same positions and bounds, and only the triangles that `keep` names.
TriangleMesh only(const TriangleMesh& mesh, const std::function<bool(std::size_t)>& keep) {
  TriangleMesh kept = mesh;
  kept.triangles.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (keep(t)) kept.triangles.push_back(mesh.triangles[t]);
  kept.triangle_normals.clear();
  kept.triangle_material.clear();
  kept.triangle_group.clear();
  return kept;
}

Effect ao_within_five() {
  Effect effect;
  effect.max_distance = {DistanceLimit::Kind::value, 5};
  return effect;
}

Film film_of(const TriangleMesh& mesh, const Effect& effect, const std::vector<SurfacePoint>& points,
             Traversal traversal = Traversal::automatic, RenderCounters* counters = nullptr) {
  Scene scene;
  scene.effects = {effect};
  scene.directions = directions;
  Renderer renderer(scene, mesh, kernel_source, traversal);
  Film film = renderer.tracer().estimate_points(points, 0, directions);
  if (counters) *counters = renderer.counters();
  return film;
}

std::vector<SurfacePoint> points_on(const TriangleMesh& mesh) {
  return vertex_points(mesh, position_normals(mesh));
}

TEST(Sets, OccludersAreTheSceneWithoutTheOthers) {
  const TriangleMesh mesh = small_mesh();
  const auto points = points_on(mesh);
  for (const Traversal traversal : {Traversal::stream, Traversal::scalar})
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"box"}, {"glossy"}, {"floor", "wall"}, {"plain"}, {"wall", "glossy"}}) {
      Effect effect = ao_within_five();
      const auto named = [&](std::size_t t) {
        return std::find(names.begin(), names.end(), mesh.groups[mesh.triangle_group[t]]) != names.end() ||
               std::find(names.begin(), names.end(), mesh.materials[mesh.triangle_material[t]].name) !=
                   names.end();
      };
      const Film oracle = film_of(only(mesh, named), effect, points);
      const Film all = film_of(mesh, effect, points);
      effect.occluders = names;
      const Film film = film_of(mesh, effect, points, traversal);
      EXPECT_EQ(film.sum, oracle.sum) << names.front();
      EXPECT_EQ(film.sum_square, oracle.sum_square) << names.front();
      EXPECT_NE(film.sum, all.sum) << names.front();
    }
}

TEST(Sets, EqualSetsShareATree) {
  const TriangleMesh mesh = small_mesh();
  Scene scene;
  scene.effects.assign(3, ao_within_five());
  scene.effects[0].occluders = {"box"};
  scene.effects[1].occluders = {"glossy"};
  scene.effects[2].occluders = {"wall"};
  const Plan plan = make_plan(scene, mesh);
  EXPECT_EQ(plan.occluder_sets.size(), 2u);
  EXPECT_EQ(plan.effects[0].tree, plan.effects[1].tree);
  EXPECT_NE(plan.effects[0].tree, plan.effects[2].tree);
}

// Each group by itself, falloff included: closest hits go through the same trees.
TEST(Sets, OnlySelfIsEachGroupAlone) {
  const TriangleMesh mesh = small_mesh();
  auto points = points_on(mesh);
  // Points within groups too, where streams of several groups meet: between floor and box.
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    vec3 centre(0);
    for (const std::uint32_t corner : mesh.triangles[t]) centre += mesh.positions[corner] / 3.0f;
    const auto& c = mesh.triangles[t];
    const vec3 normal = glm::normalize(
        glm::cross(mesh.positions[c[1]] - mesh.positions[c[0]], mesh.positions[c[2]] - mesh.positions[c[0]]));
    points.push_back(surface_point(centre, -normal, vec3(0)));
    points.back().triangle = t;
  }
  for (const Falloff falloff : {Falloff::none, Falloff::smooth})
    for (const Traversal traversal : {Traversal::stream, Traversal::scalar}) {
      Effect effect = ao_within_five();
      effect.falloff = falloff;
      Effect self = effect;
      self.only_self = true;
      const Film film = film_of(mesh, self, points, traversal);
      int shadowed = 0;
      for (std::uint32_t group = 0; group < mesh.groups.size(); ++group) {
        const Film oracle = film_of(
            only(mesh, [&](std::size_t t) { return mesh.triangle_group[t] == group; }), effect, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (points[i].triangle == 0xffffffffu || mesh.triangle_group[points[i].triangle] != group) continue;
          EXPECT_EQ(film.sum[i], oracle.sum[i]) << mesh.groups[group] << ' ' << i;
          shadowed += film.value(i) < 0.99;
        }
      }
      EXPECT_GT(shadowed, 5);
    }
}

// The camera rays of one stream see several groups.
TEST(Sets, OnlySelfInAPicture) {
  const TemporaryFolder folder;
  const std::string keys = "max_distance = 2.0\n";
  const std::string spp = "[renderer]\nspp = 8\ndirections = 4\n";
  const Image self =
      render_with_nook(folder, write_small_scene(folder, "self.toml", spp + keys + "occluders = \"self\"\n"),
                       "--aov position");
  // The floor and the wall are flat: by themselves they are open. The box is convex, and open too.
  const auto value = plane(self, "R"), hit = plane(self, "P.Z");
  const Image all = render_with_nook(folder, write_small_scene(folder, "all.toml", spp + keys));
  EXPECT_NE(plane(all, "R"), value);
  int open = 0;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (value[i] == 1) ++open;
  EXPECT_GT(open, 400);
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (hit[i] == 0) {
      EXPECT_LT(value[i], 1);
    }
  }
}

// Instances of one file are objects of their own.
TEST(Sets, InstancesDoNotOccludeEachOther) {
  const TemporaryFolder folder;
  write_bytes(folder / "bowl.obj",
              "g bowl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv 1 1 -1\nf 1 4 3 2\nf 1 2 6 5\n");
  const std::string one = "[[instance]]\nobjfile = \"bowl.obj\"\n";
  const auto mesh_of = [&](const std::string& text) {
    write_bytes(folder / "s.toml", text);
    return load_scene_mesh(load_scene(folder / "s.toml"), everything);
  };
  const TriangleMesh alone = mesh_of(one);
  const TriangleMesh pair = mesh_of(one + one + "translate = [0, 0.5, 0]\n");
  ASSERT_EQ(pair.groups.size(), 2u);
  Effect effect = ao_within_five();
  const auto points = points_on(alone);
  auto of_first = points_on(pair);
  of_first.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)  // offsets follow from the bounds of all
    for (int axis = 0; axis < 3; ++axis) of_first[i].origin[axis] = points[i].origin[axis];
  const Film oracle = film_of(alone, effect, points);
  EXPECT_NE(film_of(pair, effect, of_first).sum, oracle.sum);
  effect.only_self = true;
  EXPECT_EQ(film_of(pair, effect, of_first).sum, oracle.sum);
}

TEST(Sets, ReceiversAloneAreEstimated) {
  const TriangleMesh mesh = small_mesh();
  const auto points = points_on(mesh);
  Effect effect = ao_within_five();
  RenderCounters of_all, of_some;
  const Film all = film_of(mesh, effect, points, Traversal::automatic, &of_all);
  effect.receivers = {"box"};
  const Film some = film_of(mesh, effect, points, Traversal::automatic, &of_some);
  std::uint64_t rays = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool receives = mesh.groups[mesh.triangle_group[points[i].triangle]] == "box";
    EXPECT_EQ(some.sum[i], receives ? all.sum[i] : 0) << i;
    rays += receives ? directions : 0;
  }
  EXPECT_GT(rays, 0u);
  EXPECT_EQ(of_some.occlusion_rays, rays);
  EXPECT_GT(of_all.occlusion_rays, rays);
}

// The ground alone receives: a shadow catcher. What the plan says is uploaded, is.
TEST(Sets, TheGroundCatchesShadows) {
  const TemporaryFolder folder;
  const auto scene =
      write_small_scene(folder, "s.toml",
                        "[ground]\nheight = -0.5\n[renderer]\ndirections = 16\n[[effect]]\ntype = "
                        "\"ao\"\nreceivers = [\"ground\"]\nmax_distance = "
                        "3.0\n[[effect]]\ntype = \"ao\"\nname = \"self\"\noccluders = "
                        "\"self\"\n[[effect]]\ntype = \"ao\"\nname = "
                        "\"boxed\"\noccluders = [\"box\"]\n");
  std::string text;
  render_with_nook(folder, scene, "", &text);
  const Image image = render_with_nook(folder, scene, "--aov position");
  const auto stats = nlohmann::json::parse(text);
  const ProgramResult said = run_nook(folder, "plan --json '" + scene.string() + "'");
  ASSERT_EQ(said.code, 0) << said.err;
  const auto plan = nlohmann::json::parse(said.out);
  std::uint64_t bytes = 0;
  for (const auto& buffer : plan["buffers"]) bytes += buffer["bytes"].get<std::uint64_t>();
  EXPECT_EQ(stats["bytes_uploaded"], bytes);
  const auto value = plane(image, "R"), height = plane(image, "P.Y");
  int caught = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (height[i] > 0.05f) {
      EXPECT_EQ(value[i], 0);
    }
    caught += height[i] < -0.4f && value[i] > 0 && value[i] < 1;
  }
  EXPECT_GT(caught, 20);
}

// A ground one below a point of a wall: directions with d.y < -1/R meet it within R, of the disc that
// cosine-weighted directions fill a segment of (arccos c - c sqrt(1 - c²)) / π; without a limit it is half of
// the disc.
TEST(Sets, GroundUnderAWall) {
  constexpr double c = 0.5;  // height 1 over the limit 2
  TriangleMesh wall;
  add_quad(wall, {-0.01f, -0.01f, -1}, {0.02f, 0, 0}, {0, 0.02f, 0});
  append_ground(wall, -1, 1000);
  expect_value(estimate_at_origin(wall, ao_within(2)),
               1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / std::numbers::pi);
  Effect endless;
  endless.max_distance = {DistanceLimit::Kind::none, 0};
  expect_value(estimate_at_origin(wall, endless), 0.5);
}

TEST(Sets, UnknownNamesNameTheKnownOnes) {
  const TriangleMesh mesh = small_mesh();
  Scene scene;
  scene.file = "s.toml";
  scene.mesh_file = "small.obj";
  scene.effects = {ao_within_five()};
  scene.effects[0].receivers = {"flor"};
  expect_error(ErrorKind::scene,
               "s.toml: receivers: no group or material 'flor' in small.obj, did you mean 'floor'? (groups "
               "and materials: "
               "'box', 'floor', 'glossy', 'plain', 'wall')",
               [&] { make_plan(scene, mesh); });
}

// Plain AO beside effects with sets is built from the same options as alone.
TEST(Sets, OtherEffectsLeaveAKernelAsItIs) {
  const TriangleMesh mesh = small_mesh();
  Scene scene;
  scene.effects.assign(3, ao_within_five());
  const Plan alone = make_plan(scene, mesh);
  scene.effects[1].only_self = true;
  scene.effects[2].receivers = {"box"};
  scene.effects[2].occluders = {"wall"};
  const Plan among = make_plan(scene, mesh);
  EXPECT_EQ(occlusion_kernel(alone, alone.effects[0]).options.text(),
            occlusion_kernel(among, among.effects[0]).options.text());
  EXPECT_EQ(primary_kernel(alone).options.text(), primary_kernel(among).options.text());
  EXPECT_EQ(occlusion_kernel(among, among.effects[1]).options.text(),
            occlusion_kernel(alone, alone.effects[0]).options.text() + " -DONLY_SELF=1");
}

}  // namespace
}  // namespace nook::test
