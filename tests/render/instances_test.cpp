// Instances against their oracle, the same scene made of copies: bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "bvh/bvh.hpp"
#include "mesh/instance.hpp"
#include "support/kernels.hpp"
#include "support/meshes.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {
namespace {

// A dented sphere with smooth normals but for some corners, two materials (one with a lobe), two groups, and
// texture coordinates.
TriangleMesh dented(unsigned seed, unsigned n = 10) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.7, 1.0);
  TriangleMesh mesh;
  add_sphere(mesh, {0, 0, 0}, n, [&](unsigned, unsigned) { return radius(random); });
  for (const vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p));
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.materials = {{"shiny", 20.0f, ""}, {"cut", -1.0f, "noise.png"}};
  mesh.groups = {"one", "other"};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    auto normals = mesh.triangles[t];
    if (t % 7 == 0) normals[1] = TriangleMesh::no_normal;
    mesh.triangle_normals.push_back(normals);
    mesh.triangle_uvs.push_back({t % 4, (t + 1) % 4, (t + 2) % 4});
    mesh.triangle_material.push_back(t % 3 == 0);
    mesh.triangle_group.push_back(t % 5 == 0);
  }
  return mesh;
}

glm::dmat4 transform(const dvec3& translate, double degrees, const dvec3& axis, const dvec3& scale) {
  return glm::scale(
      glm::rotate(glm::translate(glm::dmat4(1), translate), glm::radians(degrees), glm::normalize(axis)),
      scale);
}

// Turned, stretched, sheared, mirrored, overlapping, and one as it is.
std::vector<glm::dmat4> transforms() {
  glm::dmat4 shear = transform({2.5, 0.5, 1.2}, 15, {1, 0, 1}, {0.6, 0.8, 0.7});
  shear[1][0] += 0.3;
  return {glm::dmat4(1),
          transform({1.7, 0.1, -0.4}, 33, {0, 1, 0}, dvec3(0.9)),
          transform({-1.9, -0.2, 0.3}, 77, {1, 2, 3}, {0.5, 1.4, 0.8}),
          transform({0.3, 1.6, -1}, 120, {3, -1, 0.2}, {-0.7, 0.7, 0.7}),
          transform({-0.8, 0.3, 1.8}, 5, {0, 0, 1}, {0.4, -1.1, 0.6}),
          shear,
          transform({0.2, 0.1, 0.1}, 200, {1, 1, 0}, dvec3(1.05)),
          transform({-2.2, 1.4, -1.5}, 60, {0.1, 1, 0.3}, {-0.6, -0.6, 0.9})};
}

struct Both {
  TriangleMesh copies, trees;
};

// Meshes in turn at the transforms' places, on a ground; opacity maps where `cut`.
Both scene_of(const std::vector<TriangleMesh>& meshes, const std::vector<glm::dmat4>& transforms, bool ground,
              bool cut) {
  Both both;
  std::map<std::pair<std::size_t, bool>, std::uint32_t> parts;
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    const std::size_t of = i % meshes.size();
    append_instance(both.copies, meshes[of], transforms[i]);
    const auto [part, fresh] = parts.try_emplace({of, mirrors(transforms[i])});
    if (fresh) part->second = append_model(both.trees, meshes[of], mirrors(transforms[i]));
    place_model(both.trees, part->second, transforms[i]);
  }
  for (TriangleMesh* mesh : {&both.copies, &both.trees}) {
    if (ground) append_ground(*mesh, mesh->bounds.lo.y, 30);
    if (!cut) continue;
    OpacityMap noise{"noise.png", 16, 16, {}};
    std::mt19937 random(5);
    for (int i = 0; i < 256; ++i) noise.opacity.push_back(std::uint8_t(random()));
    mesh->opacity_maps = {noise};
  }
  return both;
}

Both usual_scene(bool cut = false) {
  return scene_of({dented(1), dented(2, 6)}, transforms(), true, cut);
}

Scene view(std::vector<Effect> effects) {
  Scene scene;
  scene.camera = {{2, 3, 7}, {0, 0.3f, 0}, {0, 1, 0}, 40};
  scene.width = 48;
  scene.height = 36;
  scene.spp = 4;
  scene.directions = 6;
  scene.effects = std::move(effects);
  return scene;
}

struct Traced {
  std::vector<SurfacePoint> points;
  std::vector<Film> films;
  RenderCounters counters;
};

Traced trace(const Scene& scene, const TriangleMesh& mesh, Traversal traversal, unsigned width = 16) {
  const Plan plan = make_plan(scene, mesh, true);
  EXPECT_EQ(plan.instances, !mesh.instances.empty());
  const Bvh bvh = build_bvh(mesh, {.width = width});
  OcclusionTracer tracer(device(), plan, mesh, bvh, kernel_source, traversal);
  const auto pixels = pixels_in_order(plan.window, plan.width);
  Traced traced;
  traced.films = tracer.make_films();
  tracer.accumulate(pixels, {0, scene.spp}, traced.films);
  traced.counters = tracer.counters();
  traced.points = tracer.surface_points(pixels);
  for (SurfacePoint& point : traced.points)
    if (!(point.flags & SURFACE_HIT)) point = {};
  return traced;
}

// Materials are numbered by part in trees and by instance in copies: that they are the same ones, RO by
// material shows.
std::vector<SurfacePoint> without_materials(std::vector<SurfacePoint> points) {
  for (SurfacePoint& point : points) point.material = 0;
  return points;
}

void expect_same(const Traced& a, const Traced& b) {
  const auto p = without_materials(a.points), q = without_materials(b.points);
  ASSERT_EQ(p.size(), q.size());
  EXPECT_EQ(std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]), 0);
  ASSERT_EQ(a.films.size(), b.films.size());
  for (std::size_t e = 0; e < a.films.size(); ++e) {
    EXPECT_EQ(a.films[e].sum, b.films[e].sum);
    EXPECT_EQ(a.films[e].sum_square, b.films[e].sum_square);
    EXPECT_EQ(a.films[e].hits, b.films[e].hits);
    EXPECT_EQ(a.films[e].extra, b.films[e].extra);
  }
  EXPECT_EQ(a.counters.camera_rays, b.counters.camera_rays);
  EXPECT_EQ(a.counters.effect_rays, b.counters.effect_rays);
  EXPECT_EQ(a.counters.rejected, 0u);
}

std::size_t hits(const Traced& traced) {
  return std::size_t(std::count_if(traced.points.begin(), traced.points.end(),
                                   [](const SurfacePoint& p) { return p.flags & SURFACE_HIT; }));
}

Effect within(float limit) {
  Effect effect;
  effect.max_distance = {DistanceLimit::Kind::value, limit};
  return effect;
}

std::vector<Effect> many_effects() {
  std::vector<Effect> effects(8, within(2));
  effects[1].max_distance = {DistanceLimit::Kind::none, 0};
  effects[2].kind = effects[3].kind = EffectKind::ro;
  effects[2].sampling = effects[3].sampling = Sampling::lobe;
  effects[3].exponent_of_material = true;
  effects[4].kind = EffectKind::bent;
  effects[5].falloff = Falloff::smooth;
  effects[5].min_distance = 0.01f;
  effects[6] = within(0.5f);
  effects[6].side = Side::inside;
  effects[6].receivers = {"other"};
  effects[7].side = Side::viewer;
  effects[7].occluders = {"shiny"};
  return effects;
}

TEST(Instances, HaveTheBitsOfCopiesInEveryEffect) {
  const Both both = usual_scene();
  EXPECT_EQ(both.copies.bounds.lo, both.trees.bounds.lo);
  EXPECT_EQ(both.copies.bounds.hi, both.trees.bounds.hi);
  EXPECT_EQ(both.trees.scene_triangles(), both.copies.triangles.size());
  EXPECT_EQ(both.trees.models.size(), 5u);  // two meshes, both mirrored too, and the ground
  const Scene scene = view(many_effects());
  const Traced oracle = trace(scene, both.copies, Traversal::stream);
  EXPECT_GT(hits(oracle), 1000u);
  for (const Film& film : oracle.films)
    EXPECT_GT(std::count_if(film.sum.begin(), film.sum.end(), [](auto sum) { return sum > 0; }), 50);
  for (const unsigned width : {16u, 8u})
    for (const Traversal traversal : {Traversal::stream, Traversal::portable, Traversal::scalar}) {
      SCOPED_TRACE(testing::Message() << width << " children a node, traversal " << int(traversal));
      expect_same(oracle, trace(scene, both.trees, traversal, width));
    }
}

TEST(Instances, HaveTheBitsOfCopiesWithCutOuts) {
  const Both both = usual_scene(true);
  const Scene scene = view({within(2), many_effects()[5]});
  const Traced oracle = trace(scene, both.copies, Traversal::stream);
  EXPECT_NE(oracle.films[0].sum, trace(scene, usual_scene().copies, Traversal::stream).films[0].sum);
  for (const unsigned width : {16u, 8u})
    for (const Traversal traversal : {Traversal::stream, Traversal::portable, Traversal::scalar}) {
      SCOPED_TRACE(testing::Message() << width << " children a node, traversal " << int(traversal));
      expect_same(oracle, trace(scene, both.trees, traversal, width));
    }
}

// One size throughout from 1e-6 to 1e6, and a scene far from the origin.
TEST(Instances, HaveTheBitsOfCopiesAtAnyScale) {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6})
    for (const double far : {0.0, 1e3}) {
      SCOPED_TRACE(scale);
      SCOPED_TRACE(far);
      const dvec3 offset = scale * far * dvec3(1, -0.7, 0.3);
      std::vector<glm::dmat4> places;
      for (const glm::dmat4& m : transforms())
        places.push_back(glm::translate(glm::dmat4(1), offset) * glm::scale(glm::dmat4(1), dvec3(scale)) * m);
      const Both both = scene_of({dented(1), dented(2, 6)}, places, false, false);
      Scene scene = view({within(float(2 * scale)), many_effects()[4]});
      scene.effects[1].max_distance.value = float(3 * scale);
      scene.camera.eye = vec3(scale * dvec3(scene.camera.eye) + offset);
      scene.camera.at = vec3(scale * dvec3(scene.camera.at) + offset);
      const Traced oracle = trace(scene, both.copies, Traversal::stream);
      EXPECT_GT(hits(oracle), 400u);
      expect_same(oracle, trace(scene, both.trees, Traversal::stream));
      expect_same(oracle, trace(scene, both.trees, Traversal::scalar));
    }
}

// Instances of very different sizes in one scene, flat ones, and needles.
TEST(Instances, HaveTheBitsOfCopiesAtMixedScales) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2, 2), exponent(-6, 0.3), turn(0, 360);
  std::vector<glm::dmat4> places;
  for (int i = 0; i < 300; ++i)
    places.push_back(transform(
        {place(random), place(random), place(random)}, turn(random), {place(random), place(random), 2.5},
        {std::pow(10, exponent(random)), std::pow(10, exponent(random)), std::pow(10, exponent(random))}));
  const Both both = scene_of({dented(1), dented(2, 6), closed_box(2)}, places, true, false);
  const Scene scene = view({within(2), many_effects()[5]});
  const Traced oracle = trace(scene, both.copies, Traversal::stream);
  expect_same(oracle, trace(scene, both.trees, Traversal::stream));
  expect_same(oracle, trace(scene, both.trees, Traversal::scalar));
}

// Quads on the axes, turned by quarters: their boxes are flat, and rays meet edges.
TEST(Instances, HaveTheBitsOfCopiesOnTheAxes) {
  std::vector<glm::dmat4> places;
  for (int i = 0; i < 24; ++i)
    places.push_back(transform({double(i % 4) - 1.5, double(i / 4 % 3) - 1, double(i / 12)}, 90.0 * i,
                               {i % 3 == 0, i % 3 == 1, i % 3 == 2}, dvec3(0.5)));
  const Both both = scene_of({closed_box(3)}, places, true, false);
  Scene scene = view({within(2)});
  scene.camera.eye = {0, 0, 7};
  scene.camera.at = {0, 0, 0};
  const Traced oracle = trace(scene, both.copies, Traversal::stream);
  expect_same(oracle, trace(scene, both.trees, Traversal::stream));
  expect_same(oracle, trace(scene, both.trees, Traversal::scalar));
}

// A thousand places of a mesh cost one mesh, and less than 400 bytes each with their tree.
TEST(Instances, CostTheirPlacesAlone) {
  const TriangleMesh mesh = dented(1, 30);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-50, 50);
  std::vector<glm::dmat4> places;
  for (int i = 0; i < 1000; ++i)
    places.push_back(
        transform({place(random), place(random), place(random)}, place(random), {1, 2, 3}, dvec3(1)));
  TriangleMesh trees;
  const std::uint32_t part = append_model(trees, mesh, false);
  for (const glm::dmat4& m : places) place_model(trees, part, m);
  EXPECT_EQ(trees.positions.size(), mesh.positions.size());
  EXPECT_EQ(trees.scene_triangles(), 1000 * mesh.triangles.size());
  const std::size_t one = build_bvh(mesh).bytes(), all = build_bvh(trees).bytes();
  EXPECT_LT(all, one + 1000 * (sizeof(PlacedMesh) + 300));
}

}  // namespace
}  // namespace nook::test
