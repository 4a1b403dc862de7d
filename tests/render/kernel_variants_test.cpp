// Every specialisation of the kernels that a scene can call for, with every traversal through trees of either
// width: the same bits. The pictures are tiny, so that an interpreter can run them too
// (tests/tools/oclgrind_kernels.sh).
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <numeric>

#include "bvh/bvh.hpp"
#include "image/image.hpp"
#include "image/png.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/scene_toml.hpp"
#include "support/kernels.hpp"
#include "support/temporary_folder.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {
namespace {

struct Variant {
  const char* name;
  const char* keys;        ///< of [renderer]
  const char* input = "";  ///< of [input]
};
void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

#define NOOK_INSTANCES                                                                                      \
  "instancing = \"tree\"\n[[instance]]\nobjfile = \"mesh.obj\"\ntranslate = [0.5, 0.2, 0.3]\nscale = 0.5\n" \
  "rotate = [10, 20, 30]"

std::vector<Variant> variants() {
  std::vector<Variant> all = {
      {"surface", "type = \"ao\""},
      {"one_camera_ray", "type = \"ao\"\nspp = 1\ndirections = 40"},
      {"several_directions", "type = \"ao\"\ndirections = 3"},
      {"falloff", "type = \"ao\"\nmax_distance = 2\nfalloff = \"smooth\""},
      {"linear_falloff", "type = \"ao\"\nmax_distance = 2\nfalloff = \"linear\""},
      {"distance", "type = \"ao\"\nmax_distance = 1"},
      {"nothing_in_reach", "type = \"ao\"\nmax_distance = 0.5"},
      {"least_distance", "type = \"ao\"\nmin_distance = 0.1\nmax_distance = 2"},
      {"cone", "type = \"ao\"\ncone_angle = 40"},
      {"inside", "type = \"ao\"\nside = \"inside\""},
      {"viewer", "type = \"ao\"\nside = \"viewer\""},
      {"bent", "type = \"bent\""},
      {"bent_in_view_space", "type = \"bent\"\nspace = \"view\""},
      {"exponent_of_the_material", "type = \"ro\"\nexponent = \"material\""},
      {"occluded_by_itself", "type = \"ao\"\noccluders = \"self\""},
      {"occluders", "type = \"ao\"\noccluders = [\"plate\"]"},
      {"receivers", "type = \"ao\"\nreceivers = [\"plate\"]"},
      {"cut_outs", "type = \"ao\"", "cutouts = true"},
      {"instances", "type = \"ao\"", NOOK_INSTANCES},
      {"instances_of_the_closest", "type = \"ao\"\nmax_distance = 2\nfalloff = \"linear\"", NOOK_INSTANCES},
      {"instances_in_reach", "type = \"ao\"\nmax_distance = 0.5", NOOK_INSTANCES},
      {"instances_with_cut_outs", "type = \"ao\"", "cutouts = true\n" NOOK_INSTANCES},
      {"cut_outs_of_the_closest", "type = \"ao\"\nmax_distance = 2\nfalloff = \"linear\"", "cutouts = true"}};
  for (const char* keys :
       {"type = \"ao\"\nsampler = \"independent\"", "type = \"ao\"\nsampler = \"stratified\"",
        "type = \"ao\"\nsampler = \"halton\"", "type = \"ao\"\nsampler = \"sobol\"",
        "type = \"ao\"\nsampler = \"zorder\"", "type = \"ao\"\nsampling_type = \"hemisphere\"",
        "type = \"ao\"\nsampling_type = \"sphere\"", "type = \"ro\"\nexponent = 30\nsampling_type = \"lobe\"",
        "type = \"ro\"\nexponent = 30\nsampling_type = \"mixture\"",
        "type = \"ro\"\nexponent = 30\nsampling_type = \"cosine\"",
        "type = \"ro\"\nexponent = 30\nsampling_type = \"hemisphere\"",
        "type = \"ro\"\nexponent = 30\nsampling_type = \"sphere\""})
    all.push_back({keys, keys});
  return all;
}

/// A wavy floor with a normal of its own under a plate with a hole. Of enough triangles for the tree to have
/// nodes below its root: a tree of one node is traversed in another way.
constexpr int floor_side = 12;  // quads
std::string floor_faces() {
  std::string text;
  for (int y = 0; y <= floor_side; ++y)
    for (int x = 0; x <= floor_side; ++x)
      text += fmt::format("v {} {} {}\n", 4.0 * x / floor_side - 2, 4.0 * y / floor_side - 2,
                          0.05 * std::sin(1.7 * x) * std::cos(1.3 * y));
  constexpr int row = floor_side + 1;
  for (int y = 0; y < floor_side; ++y)
    for (int x = 0; x < floor_side; ++x) {
      const int corner = y * row + x + 1;
      text +=
          fmt::format("f {}/1/1 {}/2/1 {}/3/1 {}/4/1\n", corner, corner + 1, corner + row + 1, corner + row);
    }
  return text;
}

Scene write_scene(const TemporaryFolder& folder, const Variant& variant) {
  write_bytes(folder / "mesh.mtl",
              "newmtl shiny\nNs 30\nKs 1 1 1\nnewmtl leaf\nNs 4\nKs 1 1 1\nmap_d hole.png\n");
  Image hole;
  hole.width = hole.height = 4;
  for (const char* name : {"R", "G", "B"}) {
    std::vector<float> values(16, 1);
    values[5] = values[6] = 0;
    hole.channels.push_back({name, values});
  }
  write_png(folder / "hole.png", hole);
  write_bytes(folder / "mesh.obj",
              "mtllib mesh.mtl\nvn 0 0.1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng floor\nusemtl shiny\n" +
                  floor_faces() +
                  "g plate\nusemtl leaf\nv -0.5 -0.5 0.4\nv 0.5 -0.5 0.4\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\n"
                  "f -4/1 -3/2 -2/3 -1/4\n");
  const std::string spp = std::string(variant.keys).find("spp") == std::string::npos ? "spp = 2\n" : "";
  write_bytes(folder / "scene.toml",
              std::string("[input]\nobjfile = \"mesh.obj\"\n") + variant.input +
                  "\n[camera]\neye = [0.5, 0.3, 5.0]\nat = [0, 0, 0]\nup = [0, 1, 0]\nfov = 40\n"
                  "[film]\nwidth = 4\nheight = 3\n[renderer]\n" +
                  spp + variant.keys + "\n");
  return load_scene(folder / "scene.toml");
}

class KernelVariants : public testing::TestWithParam<Variant> {};

TEST_P(KernelVariants, EveryTraversalGivesTheSameBits) {
  const TemporaryFolder folder;
  const Scene scene = write_scene(folder, GetParam());
  const TriangleMesh mesh = load_scene_mesh(
      scene, {.normals = true, .uvs = true, .materials = true, .groups = true}, scene.instancing);
  const Plan plan = make_plan(scene, mesh, true);
  const std::vector<std::uint32_t> pixels = pixels_in_order(plan.window, plan.width);
  std::vector<Film> first;
  for (const unsigned width : {16u, 8u}) {
    // The second tree is another one in all that it may be.
    const Bvh bvh = build_bvh(mesh, {.width = width, .refined = width == 8});
    ASSERT_GE(bvh.statistics.depth, 2u);
    for (const Traversal traversal : {Traversal::stream, Traversal::portable, Traversal::scalar}) {
      if (width == 8 && traversal == Traversal::scalar && !plan.instances && !plan.asks_reach())
        continue;  // its loops know no width
      SCOPED_TRACE(testing::Message() << width << " children a node, traversal " << int(traversal));
      OcclusionTracer tracer(device(), plan, mesh, bvh, kernel_source, traversal);
      std::vector<Film> films = tracer.make_films();
      tracer.accumulate(pixels, {0, plan.samples_per_pixel()}, films);
      EXPECT_EQ(tracer.counters().rejected, 0u);
      if (first.empty()) first = films;
      EXPECT_EQ(films[0].sum, first[0].sum);
      EXPECT_EQ(films[0].sum_square, first[0].sum_square);
      EXPECT_EQ(films[0].hits, first[0].hits);
      EXPECT_EQ(films[0].extra, first[0].extra);
      EXPECT_GT(std::accumulate(films[0].sum.begin(), films[0].sum.end(), std::uint64_t(0)), 0u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, KernelVariants, testing::ValuesIn(variants()), [](const auto& variant) {
  std::string name;
  for (const char* c = variant.param.name; *c; ++c)
    if (std::isalnum(static_cast<unsigned char>(*c)) || *c == '_') name += *c;
  return name;
});

}  // namespace
}  // namespace nook::test
