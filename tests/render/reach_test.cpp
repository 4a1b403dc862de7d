// Points with nothing in reach trace no rays, and no bit of the picture tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adaptive/adaptive.hpp"
#include "bvh/bvh.hpp"
#include "effects_geometry.hpp"
#include "hard_meshes.hpp"
#include "mesh/corner_order.hpp"
#include "points/vertex_points.hpp"
#include "scene/names.hpp"
#include "support/kernels.hpp"
#include "support/meshes.hpp"
#include "support/mutants.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {
namespace {

struct Traced {
  Film film;
  RenderCounters counters;
};

Scene scene_with(const Effect& effect, std::uint32_t spp, std::uint32_t directions) {
  Scene scene;
  scene.width = 48;
  scene.height = 36;
  scene.spp = spp;
  scene.directions = directions;
  scene.effects = {effect};
  scene.automatic_camera = true;
  return scene;
}

Scene of_courtyard(const Effect& effect, std::uint32_t spp, std::uint32_t directions) {
  Scene scene = scene_with(effect, spp, directions);
  scene.automatic_camera = false;
  scene.camera = {{3, -4, 4}, {0, 0, 0.3f}, {0, 0, 1}, 45};
  return scene;
}

TriangleMesh as_loaded(TriangleMesh mesh) {
  end_with_longest_edges(mesh);
  return with_bounds(std::move(mesh));
}

// One mesh, its tree, and what an effect gives with and without asking what is in reach.
class Asked {
 public:
  explicit Asked(TriangleMesh mesh, unsigned width = 16)
      : mesh_(as_loaded(std::move(mesh))), bvh_(build_bvh(mesh_, {.width = width})) {}

  const TriangleMesh& mesh() const { return mesh_; }

  Traced picture(const Scene& scene, bool reach, Traversal traversal = Traversal::automatic,
                 const OcclusionTracer::KernelSource& source = kernel_source) const {
    return traced(scene, reach, traversal, source, [&](OcclusionTracer& tracer, const Plan& plan) {
      std::vector<Film> films = tracer.make_films();
      tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, plan.samples_per_pixel()}, films);
      return std::move(films[0]);
    });
  }

  Traced points(const Scene& scene, bool reach, const std::vector<SurfacePoint>& points,
                Traversal traversal = Traversal::automatic) const {
    return traced(scene, reach, traversal, kernel_source, [&](OcclusionTracer& tracer, const Plan&) {
      return tracer.estimate_points(points, 0, scene.directions);
    });
  }

 private:
  template <class Work>
  Traced traced(const Scene& scene, bool reach, Traversal traversal,
                const OcclusionTracer::KernelSource& source, const Work& work) const {
    Plan plan = make_plan(scene, mesh_);
    plan.effects[0].reach = reach;
    OcclusionTracer tracer(device(), plan, mesh_, bvh_, source, traversal);
    Film film = work(tracer, plan);
    return {std::move(film), tracer.counters()};
  }

  TriangleMesh mesh_;
  Bvh bvh_;
};

bool same_bits(const Film& a, const Film& b) {
  return a.sum == b.sum && a.sum_square == b.sum_square && a.hits == b.hits && a.extra == b.extra;
}

// The same sums, and fewer rays.
void expect_the_same(const Traced& asked, const Traced& all, bool some_free = true) {
  EXPECT_TRUE(same_bits(asked.film, all.film));
  EXPECT_EQ(asked.counters.rejected, all.counters.rejected);
  EXPECT_LE(asked.counters.occlusion_rays, all.counters.occlusion_rays);
  EXPECT_TRUE(!some_free || asked.counters.occlusion_rays < all.counters.occlusion_rays);
}

// n x n squares of side 2/n, turned about x and moved.
TriangleMesh floor_of(unsigned n, float angle, const vec3& offset) {
  TriangleMesh mesh;
  const float c = std::cos(angle), s = std::sin(angle);
  const auto corner = [&](unsigned i, unsigned j) {
    const float x = 2.0f * float(i) / float(n) - 1.0f, z = 2.0f * float(j) / float(n) - 1.0f;
    return vec3(x, s * z, c * z) + offset;
  };
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j)
      add_square(mesh, corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j));
  return mesh;
}

void expect_no_ray(const Traced& film, std::uint32_t directions) {
  EXPECT_EQ(film.counters.occlusion_rays, 0u);
  EXPECT_GT(film.counters.camera_rays, 0u);
  for (std::size_t i = 0; i < film.film.pixels(); ++i)
    ASSERT_EQ(film.film.sum[i], std::uint64_t(film.film.sum_scale) * directions * film.film.hits[i]);
}

constexpr std::pair<std::uint32_t, std::uint32_t> ways[] = {{16, 1}, {2, 16}, {1, 64}};  // spp, directions

TEST(Reach, AFloorTracesNothing) {
  for (const unsigned n : {1u, 7u, 12u}) {
    const Asked floor(floor_of(n, 0, vec3(0)));
    for (const auto& [spp, directions] : ways) {
      SCOPED_TRACE(testing::Message() << n << " squares a side, " << spp << " x " << directions);
      expect_no_ray(floor.picture(scene_with(ao_within(0.1f), spp, directions), true), directions);
    }
  }
}

// Its boxes reach above it, so that more of them are looked at than a render grants; and its corners are
// rounded, so that a square may rise above its neighbour by more than a point is off it.
TEST(Reach, ATiltedFloorTracesAlmostNothing) {
  const Asked floor(floor_of(12, -0.3f, vec3(3, 1, 2)));
  const auto patient = [&](const std::string& file) {
    const std::string text = kernel_source(file);
    return file == "stage/occlusion.cl"
               ? mutate(text, "#define REACH_VISITS 12u", "#define REACH_VISITS 400u")
               : text;
  };
  for (const auto& [spp, directions] : ways) {
    SCOPED_TRACE(testing::Message() << spp << " x " << directions);
    const Scene scene = scene_with(ao_within(0.1f), spp, directions);
    const Traced all = floor.picture(scene, false);
    const Traced asked = floor.picture(scene, true, Traversal::automatic, patient);
    expect_the_same(asked, all);
    EXPECT_LT(asked.counters.occlusion_rays, all.counters.occlusion_rays / 100);
  }
}

TEST(Reach, PicturesHaveTheSameBits) {
  const std::pair<const char*, TriangleMesh> meshes[] = {
      {"courtyard", courtyard()},
      {"sphere", sphere_on_floor(1, vec3(0))},
      {"far sphere", sphere_on_floor(1, vec3(1000, 200, -3000))},
      {"small sphere", sphere_on_floor(1e-6f, vec3(0))},
      {"wedge", wedge(0.02f, 1)},
      {"slivers", bad_floor(1)},
      {"star", spiky_star(40, 0.7f)},
      {"smooth sphere", smooth_sphere(12)},
      {"leaning", leaning_square(1, 0.4)},
      {"shrinking", shrinking_triangles(20)},
      {"floor", floor_of(50, 0.7f, vec3(5, -2, 1))}};
  for (const auto& [name, mesh] : meshes) {
    const Asked asked(mesh);
    const float radius = asked.mesh().subject_bounds().bounding_radius();
    for (const float share : {0.002f, 0.03f, 0.3f})
      for (const auto& [spp, directions] : {std::pair{16u, 1u}, {3u, 20u}}) {
        SCOPED_TRACE(testing::Message()
                     << name << " within " << share * radius << ", " << spp << " x " << directions);
        const Scene scene = scene_with(ao_within(share * radius), spp, directions);
        expect_the_same(asked.picture(scene, true), asked.picture(scene, false), false);
      }
  }
}

TEST(Reach, EveryTraversalAsks) {
  const Scene scene = of_courtyard(ao_within(0.2f), 16, 1);
  const Traced all = Asked(courtyard()).picture(scene, false);
  for (const unsigned width : {16u, 8u}) {
    SCOPED_TRACE(testing::Message() << width << " children a node");
    const Asked court(courtyard(), width);
    const Traced stream = court.picture(scene, true, Traversal::stream);
    expect_the_same(stream, all);
    for (const Traversal traversal : {Traversal::portable, Traversal::scalar}) {
      const Traced other = court.picture(scene, true, traversal);
      expect_the_same(other, all);
      EXPECT_EQ(other.counters.occlusion_rays, stream.counters.occlusion_rays);
    }
  }
}

TEST(Reach, EveryEffectKeepsItsBits) {
  std::vector<std::pair<const char*, Effect>> effects;
  const auto add = [&](const char* name, auto change) {
    effects.emplace_back(name, ao_within(0.2f));
    change(effects.back().second);
  };
  add("hemisphere", [](Effect& e) { e.sampling = Sampling::hemisphere; });
  add("sphere", [](Effect& e) { e.sampling = Sampling::sphere; });
  add("cone", [](Effect& e) { e.cone_angle = 40; });
  add("falloff", [](Effect& e) { e.falloff = Falloff::smooth; });
  add("min_distance", [](Effect& e) { e.min_distance = 0.02f; });
  add("min_distance, falloff", [](Effect& e) { e.min_distance = 0.1f, e.falloff = Falloff::linear; });
  add("inside", [](Effect& e) { e.side = Side::inside; });
  add("viewer", [](Effect& e) { e.side = Side::viewer; });
  add("bent", [](Effect& e) { e.kind = EffectKind::bent; });
  add("RO", [](Effect& e) { e.kind = EffectKind::ro, e.sampling = Sampling::lobe, e.exponent = 30; });
  add("RO by cosine", [](Effect& e) { e.kind = EffectKind::ro, e.exponent = 3; });
  const Asked court(courtyard());
  for (const auto& [name, effect] : effects)
    for (const std::uint32_t directions : {1u, 20u}) {
      SCOPED_TRACE(testing::Message() << name << ", 8 x " << directions);
      const Scene scene = of_courtyard(effect, 8, directions);
      expect_the_same(court.picture(scene, true), court.picture(scene, false));
    }
}

// Of two floors, one above the other, each is alone with its own group's tree.
TEST(Reach, GroupsHaveTreesOfTheirOwn) {
  TriangleMesh mesh = floor_of(4, 0, vec3(0));
  for (const std::uint32_t group : {0u, 1u}) {
    if (group) {
      const TriangleMesh above = floor_of(4, 0, vec3(0, 0.05f, 0));
      for (const auto& t : above.triangles) {
        const auto first = std::uint32_t(mesh.positions.size());
        for (const std::uint32_t corner : t) mesh.positions.push_back(above.positions[corner]);
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
    }
    mesh.triangle_group.resize(mesh.triangles.size(), group);
  }
  mesh.groups = {"below", "above"};
  const Asked floors(mesh);
  const auto points = vertex_points(floors.mesh(), position_normals(floors.mesh()));
  Effect effect = ao_within(0.1f);
  const Traced together = floors.points(scene_with(effect, 1, 40), true, points);
  expect_the_same(together, floors.points(scene_with(effect, 1, 40), false, points));
  EXPECT_GT(together.counters.occlusion_rays, 0u);
  effect.only_self = true;
  const Traced alone = floors.points(scene_with(effect, 1, 40), true, points);
  EXPECT_TRUE(same_bits(alone.film, floors.points(scene_with(effect, 1, 40), false, points).film));
  EXPECT_EQ(alone.counters.occlusion_rays, 0u);
}

// The pictures above would tell if it asked about too little.
TEST(Reach, TooSmallAReachShows) {
  const Asked court(courtyard());
  const Scene scene = of_courtyard(ao_within(0.2f), 64, 1);
  const Traced all = court.picture(scene, false);
  for (const auto& [find, replace] :
       {std::pair{"apart > limit * limit", "apart > 0.3f * limit * limit"},
        {"(high < height", "(high < height + 0.5f"},
        {"return OR_LEAF_LANES((out == 0) & filled) != 0;", "return false;"},
        {"return NONZERO_CHILDREN(out == 0) & filled;",
         "return NONZERO_CHILDREN(out == 0) & filled & 0xfff0u;"},
        {"r->spread = one_origin ? 0.0f : most_lane(spread);", "r->spread = -0.1f;"}}) {
    SCOPED_TRACE(find);
    const auto mutant = [&](const std::string& file) {
      const std::string text = kernel_source(file);
      return file == "stage/occlusion.cl" ? mutate(text, find, replace) : text;
    };
    EXPECT_FALSE(same_bits(court.picture(scene, true, Traversal::automatic, mutant).film, all.film));
  }
}

// Far from its parts the courtyard's floor is done after the first samples, exactly; near them pixels take
// what they need.
TEST(Reach, APixelWithNothingInReachStopsAtOnce) {
  const TriangleMesh mesh = with_bounds(courtyard());
  const Bvh bvh = build_bvh(mesh);
  for (const Sampler sampler : {Sampler::independent, Sampler::sobol})
    for (const Sampling sampling : {Sampling::cosine, Sampling::sphere}) {
      SCOPED_TRACE(testing::Message() << name_of(sampler) << ", " << name_of(sampling));
      Scene scene = of_courtyard(ao_within(0.2f), 16, 1);
      scene.sampler = sampler;
      scene.effects[0].sampling = sampling;
      ErrorTarget target;
      target.error = 0.02;
      target.max_spp = 4096;
      const auto rendered = [&](bool reach) {
        Plan plan = make_plan(scene, mesh);
        plan.effects[0].reach = reach;
        plan = AdaptiveRender::plan_for(plan, target);
        OcclusionTracer tracer(device(), plan, mesh, bvh);
        return AdaptiveRender(tracer, plan, target).run().effects[0];
      };
      const PixelEstimates asked = rendered(true), all = rendered(false);
      const std::uint32_t first = *std::min_element(asked.samples.begin(), asked.samples.end());
      std::size_t stopped = 0, others = 0;
      for (std::size_t i = 0; i < asked.value.size(); ++i) {
        if (asked.value[i] == 1 && asked.variance[i] == 0) {
          EXPECT_EQ(asked.samples[i], first);
          EXPECT_NEAR(all.value[i], 1, 5 * target.error);
          ++stopped;
        } else if (asked.variance[i] > 0) {
          ++others;
        }
      }
      EXPECT_GT(stopped, 150u);
      EXPECT_GT(others, 100u);
      const auto samples_of = [](const PixelEstimates& made) {
        return std::accumulate(made.samples.begin(), made.samples.end(), 0ull);
      };
      // Sobol' samples that do not vary stop at the first stage by themselves.
      EXPECT_LE(samples_of(asked), samples_of(all));
      EXPECT_TRUE(sampler != Sampler::independent || samples_of(asked) < samples_of(all));
    }
}

TEST(Reach, IsAskedWithinASmallPartOfTheScene) {
  const TriangleMesh mesh = with_bounds(courtyard());
  const float radius = mesh.subject_bounds().bounding_radius();
  const auto asked = [&](const DistanceLimit& limit) {
    Effect effect;
    effect.max_distance = limit;
    return make_plan(scene_with(effect, 16, 1), mesh).effects[0].reach;
  };
  EXPECT_TRUE(asked({DistanceLimit::Kind::value, 0.2f * radius}));
  EXPECT_FALSE(asked({DistanceLimit::Kind::value, 0.3f * radius}));
  EXPECT_FALSE(asked({DistanceLimit::Kind::none, 0}));
}

}  // namespace
}  // namespace nook::test
