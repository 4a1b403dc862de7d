// Cut-outs: closed forms, and bit for bit the scene without what is cut.
#include <gtest/gtest.h>

#include <random>

#include "base/error.hpp"
#include "effects_geometry.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/scene_toml.hpp"
#include "support/nook_program.hpp"

namespace nook::test {
namespace {

Effect ao_within(DistanceLimit limit) {
  Effect effect;
  effect.max_distance = limit;
  return effect;
}

// Gives every triangle the map; quads as add_quad() makes them have the whole of it.
void map_onto(TriangleMesh& mesh, OpacityMap map) {
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangle_uvs.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangle_uvs.push_back(t % 2 ? std::array<std::uint32_t, 3>{0, 2, 3}
                                      : std::array<std::uint32_t, 3>{0, 1, 2});
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  mesh.materials = {{"leaf", -1.0f, map.file}};
  mesh.opacity_maps = {std::move(map)};
}

OpacityMap half() {
  return {"half.png", 2, 1, {255, 0}};
}

// A ceiling z = 1 whose half x > 0 is cut away: half of an endless ceiling's directions are open.
TEST(CutOut, HalfPlane) {
  TriangleMesh ceiling = plane_at(1);
  map_onto(ceiling, half());
  expect_value(estimate_at_origin(ceiling, ao_within({DistanceLimit::Kind::none, 0})), 0.5);
  // Within R = 2 a ceiling leaves c² = 1/4 open.
  const Effect near = ao_within({DistanceLimit::Kind::value, 2});
  expect_value(estimate_at_origin(plane_at(1), near), 0.25);
  expect_value(estimate_at_origin(ceiling, near), (1 + 0.25) / 2);
}

// Closest hits go through holes too: linear falloff has 2c - c² under a whole ceiling, and a bent normal
// leans to the hole.
TEST(CutOut, HalfPlaneOfClosestHits) {
  TriangleMesh ceiling = plane_at(1);
  map_onto(ceiling, half());
  Effect effect = ao_within({DistanceLimit::Kind::value, 2});
  effect.falloff = Falloff::linear;
  expect_value(estimate_at_origin(ceiling, effect), (1 + 0.75) / 2);
}

// Texels interpolate: of a map that rises from 0 to 255 over its height, half of the period lies above 127.5.
TEST(CutOut, MapsAreInterpolatedAndRepeat) {
  TriangleMesh ceiling = plane_at(1);
  map_onto(ceiling, {"ramp.png", 1, 2, {255, 0}});
  for (vec2& uv : ceiling.uvs) uv = 2000.0f * uv - 700.0f;  // strips of half a unit
  expect_value(estimate_at_origin(ceiling, ao_within({DistanceLimit::Kind::none, 0})), 0.5);
}

// map_d's options: an offset moves the map; clamped it is there once, and the surface is whole beside it.
TEST(CutOut, MapsAreMovedAndClamped) {
  TriangleMesh ceiling = plane_at(1);
  map_onto(ceiling, half());
  const Effect unlimited = ao_within({DistanceLimit::Kind::none, 0});
  ceiling.materials[0].map.offset = vec2(1, 0);
  expect_value(estimate_at_origin(ceiling, unlimited), 0.5);
  ceiling.materials[0].map.clamp = ceiling.opacity_maps[0].lookup.clamp = true;
  expect_value(estimate_at_origin(ceiling, unlimited), 0);
  ceiling.materials[0].map.offset = vec2(0);
  expect_value(estimate_at_origin(ceiling, unlimited), 0.5);
}

struct Traced {
  std::vector<std::uint64_t> ao, falloff;
  std::vector<std::uint32_t> triangle;
};

std::string portable_source(const std::string& file) {
  return "#define TRAVERSAL_PORTABLE 1\n" + kernel_source(file);
}

// A picture by AO and by closest hits, and the triangle under each pixel.
Traced trace(const TriangleMesh& mesh, Traversal traversal,
             const OcclusionTracer::KernelSource& source = kernel_source) {
  Scene scene;
  scene.camera = {{0.3f, 0.2f, 6}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.width = 40;
  scene.height = 30;
  scene.spp = 8;
  scene.directions = 4;
  scene.effects = {ao_within({DistanceLimit::Kind::value, 2}), ao_within({DistanceLimit::Kind::value, 2})};
  scene.effects[1].falloff = Falloff::smooth;
  Renderer renderer(scene, mesh, source, traversal);
  const std::vector<Film> films = renderer.films();
  const auto pixels = pixels_in_order(renderer.plan().window, renderer.plan().width);
  Traced traced{films[0].sum, films[1].sum, {}};
  for (const SurfacePoint& point : renderer.tracer().surface_points(pixels))
    traced.triangle.push_back(point.flags & SURFACE_HIT ? point.triangle : 0xffffffffu);
  return traced;
}

// Sheets one behind another, the first of them tilted.
TriangleMesh sheets() {
  TriangleMesh mesh;
  for (int i = 0; i < 6; ++i)
    add_quad(mesh, {-2, -1.5f, 0.5f * float(i) - 2}, {4, 0, 0.2f * float(i)}, {0, 3, 0.1f * float(i)});
  return mesh;
}

TEST(CutOut, TraversalsAgreeToTheBit) {
  TriangleMesh mesh = sheets();
  std::mt19937 random(1);
  OpacityMap noise{"noise.png", 16, 16, {}};
  for (int i = 0; i < 256; ++i) noise.opacity.push_back(std::uint8_t(random()));
  map_onto(mesh, noise);
  const Traced stream = trace(mesh, Traversal::stream), scalar = trace(mesh, Traversal::scalar),
               portable = trace(mesh, Traversal::stream, portable_source);
  for (const Traced& other : {scalar, portable}) {
    EXPECT_EQ(stream.ao, other.ao);
    EXPECT_EQ(stream.falloff, other.falloff);
    EXPECT_EQ(stream.triangle, other.triangle);
  }
  EXPECT_NE(stream.ao, trace(sheets(), Traversal::stream).ao);
}

// A map of 255 cuts nothing; one of 0 cuts all: the scene without its triangles.
TEST(CutOut, WholeAndEmptyMapsAreTheirOracles) {
  TriangleMesh mesh = sheets();
  map_onto(mesh, {"white.png", 3, 2, std::vector<std::uint8_t>(6, 255)});
  const Traced whole = trace(mesh, Traversal::stream), without_map = trace(sheets(), Traversal::stream);
  EXPECT_EQ(whole.ao, without_map.ao);
  EXPECT_EQ(whole.triangle, without_map.triangle);

  // The two front sheets are cut away entirely.
  map_onto(mesh, {"black.png", 1, 1, {0}});
  mesh.materials.push_back({"wood", -1.0f, ""});
  TriangleMesh kept = sheets();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.triangle_material[t] = t >= 8 ? 0 : 1;
  kept.triangles.resize(8);
  const Traced cut = trace(mesh, Traversal::stream), oracle = trace(kept, Traversal::stream);
  EXPECT_EQ(cut.ao, oracle.ao);
  EXPECT_EQ(cut.falloff, oracle.falloff);
  EXPECT_EQ(cut.triangle, oracle.triangle);
  EXPECT_NE(cut.ao, whole.ao);
}

// Only where the scene asks and a material has a map is anything read, uploaded or compiled.
TEST(CutOut, CostNothingWithoutAMap) {
  const TemporaryFolder folder;
  const auto file = write_small_scene(folder, "s.toml", "[renderer]\nspp = 4\n");
  const auto load = [&](bool cutouts) {
    Scene scene = load_scene(file);
    scene.cutouts = cutouts;
    const TriangleMesh mesh = load_scene_mesh(scene, needed_attributes(scene));
    return std::pair(make_plan(scene, mesh), mesh);
  };
  const auto [plain, plain_mesh] = load(false);
  const auto [without_map, same_mesh] = load(true);
  EXPECT_FALSE(without_map.cutouts);
  EXPECT_EQ(primary_kernel(plain).options.text(), primary_kernel(without_map).options.text());
  write_bytes(folder / "small.mtl", std::string(small_mtl) + "map_d none.png\n");
  EXPECT_FALSE(load(false).first.cutouts);
  EXPECT_THROW(load(true), Error);
}

}  // namespace
}  // namespace nook::test
