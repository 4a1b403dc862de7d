// The hard cases of docs/hard-cases.md on the kernels that users run, with every traversal; each expected
// value is derived where it stands.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "bvh/bvh.hpp"
#include "device/kernel_source.hpp"
#include "hard_meshes.hpp"
#include "render/path_tracer.hpp"
#include "render/points.hpp"
#include "support/kernels.hpp"
#include "support/meshes.hpp"
#include "support/mutants.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A mesh ready to be looked at, or probed.
class Case {
 public:
  explicit Case(TriangleMesh mesh) : mesh_(with_bounds(std::move(mesh))), bvh_(build_bvh(mesh_)) {
    scene.effects = {Effect{}};
    scene.effects[0].max_distance.kind = DistanceLimit::Kind::none;
    scene.sampler = Sampler::independent;
    scene.width = scene.height = 16;
  }
  void limit(float distance) { scene.effects[0].max_distance = {DistanceLimit::Kind::value, distance}; }
  void reflect(float exponent) {
    scene.effects[0].kind = EffectKind::ro;
    scene.effects[0].sampling = Sampling::lobe;
    scene.effects[0].exponent = exponent;
  }
  Film render(Traversal traversal, const PathTracer::KernelSource& source = kernel_source) const {
    const Plan plan = make_plan(scene, mesh_);
    PathTracer tracer(device(), plan, mesh_, bvh_, source, traversal);
    std::vector<Film> films = tracer.make_films();
    tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, plan.samples_per_pixel()}, films);
    EXPECT_EQ(tracer.counters().rejected, 0u);
    return std::move(films[0]);
  }
  Film probe(Traversal traversal, const std::vector<SurfacePoint>& points, std::uint32_t directions,
             std::uint64_t rejected = 0) const {
    Scene at_points = scene;
    at_points.spp = 1;
    PathTracer tracer(device(), make_plan(at_points, mesh_), mesh_, bvh_, kernel_source, traversal);
    Film film = tracer.estimate_points(points, 0, directions);
    EXPECT_EQ(tracer.counters().rejected, rejected);
    return film;
  }
  SurfacePoint point(vec3 position, vec3 normal, vec3 view = vec3(0)) const {
    return surface_point(position, normal, view, mesh_.bounds);
  }
  const TriangleMesh& mesh() const { return mesh_; }
  const Bvh& bvh() const { return bvh_; }

  Scene scene;

 private:
  TriangleMesh mesh_;
  Bvh bvh_;
};

class HardCases : public testing::TestWithParam<Traversal> {
 protected:
  /// Every pixel that hits anything has exactly this value: 1 or 0, whose sums are integers.
  static void expect_all(const Film& film, double value) {
    std::uint64_t hits = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      hits += film.hits[i];
      if (film.hits[i] == film.camera_samples[i]) {
        EXPECT_EQ(film.value(i), value) << "pixel " << i;
      }
    }
    EXPECT_GT(hits, 0u);
  }
  /// Within five standard errors of a frequency, and `slack` for what the mesh is not.
  static void expect_near(double value, double expected, std::uint32_t directions, double slack = 0) {
    EXPECT_NEAR(value, expected,
                5 * std::sqrt(std::max(expected * (1 - expected), 1e-9) / directions) + slack);
  }
};

INSTANTIATE_TEST_SUITE_P(Traversals, HardCases,
                         testing::Values(Traversal::stream, Traversal::portable, Traversal::scalar),
                         [](const auto& traversal) {
                           return traversal.param == Traversal::stream     ? "stream"
                                  : traversal.param == Traversal::portable ? "portable"
                                                                           : "scalar";
                         });

// A unit sphere on a floor: from a floor point at distance D of its centre it covers the cosine-weighted
// share sin^2(a) cos(t) with sin a = 1/D and cos t = 1/D, so AO = 1 - 1/D^3. The facets of the sphere are
// inside it: 0.002 of slack.
TEST_P(HardCases, ContactAtEveryScale) {
  for (const float scale : {1.0f, 1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const Case contact(sphere_on_floor(scale, vec3(0)));
    for (const float x : {0.25f, 0.5f, 1.0f, 2.0f}) {
      const Film film =
          contact.probe(GetParam(), {contact.point(vec3(x * scale, 0, 0), {0, 1, 0})}, 1u << 16);
      expect_near(film.value(0), 1 - std::pow(1 + double(x) * x, -1.5), 1u << 16, 0.002);
    }
  }
}

// Powers of two scale every operation exactly: the same bits.
TEST_P(HardCases, PicturesAtPowerOfTwoScalesAreTheSameBits) {
  const auto picture = [&](float scale) {
    Case contact(sphere_on_floor(scale, vec3(0)));
    contact.scene.camera = {vec3(0, 3, 5) * scale, vec3(0, 0.75, 0) * scale, {0, 1, 0}, 32};
    contact.scene.spp = 16;
    return contact.render(GetParam());
  };
  const Film one = picture(1);
  for (const float scale : {0x1p-20f, 0x1p20f}) {
    const Film other = picture(scale);
    EXPECT_EQ(other.sum, one.sum) << scale;
    EXPECT_EQ(other.hits, one.hits) << scale;
  }
}

// Moved by d, positions are rounded to half an ulp of d, e = 2^-24 d: facets turn by about e over their size
// (here 1/16), and AO by as much. Beyond d = 1e4 times the size that is no longer small; then only sane
// values are asked for.
TEST_P(HardCases, ContactMovedFarAway) {
  for (const float d : {10.0f, 1e3f, 1e4f, 1e6f}) {
    const Case contact(sphere_on_floor(1, vec3(d)));
    const double rounding = d * 0x1p-24, tolerance = 0.002 + 16 * 4 * rounding;
    const Film film = contact.probe(GetParam(), {contact.point(vec3(d + 1, d, d), {0, 1, 0})}, 1u << 16);
    const double value = film.value(0);
    if (tolerance < 0.2)
      expect_near(value, 1 - std::pow(2.0, -1.5), 1u << 16, tolerance);
    else
      EXPECT_TRUE(value >= 0 && value <= 1) << value;
  }
}

// Two half planes at an angle g, seen from one: (1 - cos g)/2. The plates are 1e4 times the distance to their
// edge, which leaves out less than 1e-4 of the hemisphere.
TEST_P(HardCases, SharpWedges) {
  for (const double degrees : {60.0, 10.0, 3.0, 1.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Case corner(wedge(float(angle), 1e4f));
    const Film film = corner.probe(GetParam(), {corner.point({1, 0, 0}, {0, 1, 0})}, 1u << 20);
    expect_near(film.value(0), (1 - std::cos(angle)) / 2, 1u << 20, 1e-4);
  }
}

// A flat floor has nothing above it: AO is exactly 1, however its triangles are made.
TEST_P(HardCases, FlatFloorOfBadTrianglesNeverShadowsItself) {
  for (const float scale : {1e-6f, 1.0f, 1e6f}) {
    Case floor(bad_floor(scale));
    floor.scene.camera = {vec3(0.3f, 1, 0.4f) * scale, vec3(0), {0, 0, 1}, 60};
    floor.scene.spp = 64;
    expect_all(floor.render(GetParam()), 1);
  }
}

// Inside a closed mesh no direction is open: exactly 0.
TEST_P(HardCases, ClosedMeshIsDarkInside) {
  Case star(spiky_star(24, 0.4f));
  star.scene.camera = {{0.1f, 0.05f, 0.02f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 120};
  star.scene.spp = 64;
  star.scene.directions = 8;
  expect_all(star.render(GetParam()), 0);
}

// A distance limit of 0 sees nothing, and so does one far below every size; one beyond the scene is as good
// as none.
TEST_P(HardCases, DistanceLimits) {
  Case box(closed_box(2));
  box.scene.camera = {{0, 0, 0.5f}, {0.2f, 0.1f, -1}, {0, 1, 0}, 60};
  box.scene.spp = 16;
  for (const float limit : {0.0f, 1e-38f, 1e-20f}) {
    box.limit(limit);
    expect_all(box.render(GetParam()), 1);
  }
  for (const float limit : {1e3f, 1e38f, infinity}) {
    box.limit(limit);
    expect_all(box.render(GetParam()), 0);
  }
}

TEST_P(HardCases, ExtremeCamerasSeeAnOpenFloor) {
  Case floor(square(100));
  floor.scene.spp = 4;
  const auto expect_open = [&](const Camera& camera, int width, int height) {
    floor.scene.camera = camera;
    floor.scene.width = width;
    floor.scene.height = height;
    expect_all(floor.render(GetParam()), 1);
  };
  for (const float fov : {0.01f, 30.0f, 179.0f})
    expect_open({{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, fov}, 16, 16);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 60}, 1, 1);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 60}, 1, 20000);
  expect_open({{0.1f, 2, 0.2f}, {0, 0, 0}, {0, 0, 1}, 1}, 20000, 1);
  // The closest that a camera can come: the next float above the floor.
  expect_open({{0.1f, std::numeric_limits<float>::denorm_min(), 0.2f}, {0.1f, -1, 0.2f}, {0, 0, 1}, 60}, 4,
              4);
}

// Exactly on a surface, and inside a wall: whatever is seen has a finite value in [0, 1].
TEST_P(HardCases, CameraOnASurfaceOrInAWall) {
  for (const vec3 eye : {vec3(0.25f, -1, 0.1f), vec3(1, 1, 1), vec3(0.3f, 0.99999994f, 0)}) {
    Case box(closed_box(4));
    box.scene.camera = {eye, {0.1f, 0.2f, 0.3f}, {0, 1, 0}, 90};
    const Film film = box.render(GetParam());
    for (std::size_t i = 0; i < film.pixels(); ++i)
      EXPECT_TRUE(film.value(i) >= 0 && film.value(i) <= 1) << film.value(i);
  }
}

// Nothing to see is black; one triangle from above is open.
TEST_P(HardCases, NoTriangleAndOne) {
  Case nothing{TriangleMesh{}};
  nothing.scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 30};
  const Film empty = nothing.render(GetParam());
  for (std::size_t i = 0; i < empty.pixels(); ++i) EXPECT_EQ(empty.hits[i], 0u);
  Case one(single_triangle());
  one.scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 30};
  expect_all(one.render(GetParam()), 1);
}

// Triangles that halve in size towards a corner make the deepest tree that a surface area heuristic can be
// led to; its levels must fit the traversal's stack, and the outermost wall must still be seen through all of
// them.
TEST_P(HardCases, WorstCaseDepth) {
  const Case nested(shrinking_triangles(120));
  EXPECT_LE(nested.bvh().statistics.depth, unsigned(BVH_MAX_DEPTH));
  const Film film = nested.probe(
      GetParam(), {nested.point({0, 0, -1}, {0, 0, -1}), nested.point({0.01f, 0.01f, -1}, {0, 0, 1})}, 4096);
  EXPECT_EQ(film.value(0), 1);
  EXPECT_LT(film.value(1), 1);
}

// The lobe's weight is (n+2)/(n+1) N.w in [0, 2]; over an open horizon the mean tends to cos(theta) for large
// n.
TEST_P(HardCases, PhongExponentsAtEveryViewAngle) {
  for (const float exponent : {0.0f, 1.0f, 30.0f, 1e3f, 1e5f, 1e7f}) {
    Case open(single_triangle());
    open.reflect(exponent);
    std::vector<SurfacePoint> points;
    const double degrees[] = {0, 30, 60, 80, 89, 89.99, 90};
    for (const double angle : degrees) {
      const double a = angle * std::numbers::pi / 180;
      points.push_back(open.point({50, 50, 50}, {0, 0, 1}, vec3(float(-std::sin(a)), 0, float(std::cos(a)))));
    }
    const Film film = open.probe(GetParam(), points, 1u << 14);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_TRUE(film.value(i) >= 0 && film.value(i) <= 1.01)
          << film.value(i) << " at " << degrees[i] << ", " << exponent;
      // Standard deviation of a weight: below sin(theta)/sqrt(n) + 1/n.
      if (exponent >= 1e5f && degrees[i] <= 80) {
        EXPECT_NEAR(film.value(i), std::cos(degrees[i] * std::numbers::pi / 180),
                    5 / std::sqrt(exponent * double(1u << 14)) + 2e-5);
      }
    }
  }
}

// What is not finite is counted, and adds nothing.
TEST_P(HardCases, NonFinitePointsAreCountedAndKeptOut) {
  const Case box(closed_box(2));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<SurfacePoint> points(3, box.point({0, 0, 0}, {0, 0, 1}));
  points[0].normal[1] = nan;
  points[1].origin[0] = infinity;
  const Film film = box.probe(GetParam(), points, 1000, 2000);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(film.sum[i], 0u);
}

// The least and the greatest numbers that a sampler can return, 0, 2^-24 and 1 - 2^-24, in all pairs, drawn
// by the kernels in place of their random numbers: in a closed box no direction is open, above a floor no ray
// of AO is blocked, and every weight is finite.
TEST_P(HardCases, EndsOfTheSquare) {
  const PathTracer::KernelSource ends = [](const std::string& file) {
    return mutate(kernel_source(file),
                  "    uint4 h = pcg4d(pixel, sample, direction, p->seed);\n"
                  "    u.x = uint_to_unit_float(h.x);\n"
                  "    u.y = uint_to_unit_float(h.y);\n",
                  "    const float ends[3] = {0.0f, 0x1p-24f, 1.0f - 0x1p-24f};\n"
                  "    u.x = ends[index % 3u];\n"
                  "    u.y = ends[index / 3u % 3u];\n");
  };
  Case box(closed_box(2)), floor(square(100));
  box.scene.camera = {{0, 0, 0.5f}, {0.2f, 0.1f, -1}, {0, 1, 0}, 60};
  floor.scene.camera = {{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, 60};
  for (Case* each : {&box, &floor}) each->scene.spp = 9;
  for (const Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    box.scene.effects[0].sampling = sampling;
    expect_all(box.render(GetParam(), ends), 0);
  }
  expect_all(floor.render(GetParam(), ends), 1);
  for (const float exponent : {0.0f, 30.0f, 1e7f})
    for (const Sampling sampling :
         {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
      box.reflect(exponent);
      floor.reflect(exponent);
      box.scene.effects[0].sampling = floor.scene.effects[0].sampling = sampling;
      expect_all(box.render(GetParam(), ends), 0);
      const Film film = floor.render(GetParam(), ends);
      for (std::size_t i = 0; i < film.pixels(); ++i)
        EXPECT_TRUE(film.value(i) >= 0 && std::isfinite(film.value(i))) << film.value(i);
    }
}

// A plane whose shading normal leans by t: of the cosine-weighted hemisphere about it, the share (1 + cos
// t)/2 lies above the plane; the rest goes through the plane and is blocked. This is the terminator's whole
// darkening, (1 - cos t)/2.
TEST_P(HardCases, LeaningNormalsLoseWhatLiesBelowThePlane) {
  for (const double degrees : {5.0, 30.0, 60.0, 85.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    Case plane(leaning_square(1000, angle));
    plane.scene.camera = {{0.1f, 2, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, 1}, 20};
    plane.scene.spp = 256;
    const Film film = plane.render(GetParam());
    double mean = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) mean += film.value(i) / double(film.pixels());
    expect_near(mean, (1 + std::cos(angle)) / 2, std::uint32_t(256 * film.pixels()), 1e-5);
  }
}

// A convex body occludes nothing of itself, AO = 1; smooth normals on its facets lean by at most the angle t
// between a facet's plane and the sphere at its corners, and no pixel loses more than (1 - cos t)/2 to the
// terminator. Facets of n x 2n: t is at most pi/n in each direction, together sqrt(2)/2 pi/n.
TEST_P(HardCases, TerminatorOfASmoothSphere) {
  for (const unsigned n : {8u, 16u, 64u}) {
    Case sphere(smooth_sphere(n));
    sphere.scene.camera = {{0.3f, 0.4f, 4}, {0, 0, 0}, {0, 1, 0}, 20};
    sphere.scene.spp = 1024;
    const Film film = sphere.render(GetParam());
    const double lean = std::numbers::pi / n * std::numbers::sqrt2 / 2, bound = (1 - std::cos(lean)) / 2;
    double mean = 0, seen = 0, worst = 0;
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (film.hits[i] != film.camera_samples[i]) continue;
      mean += 1 - film.value(i);
      worst = std::max(worst, 1 - film.value(i));
      seen += 1;
    }
    mean /= seen;
    EXPECT_GT(seen, 100);
    EXPECT_LE(worst, bound + 5 * std::sqrt(bound / 1024)) << n;
    EXPECT_GT(mean, bound / 20) << n;  // it is there: a smooth sphere of facets is darker than a sphere
    EXPECT_LT(mean, bound / 2) << n;
    RecordProperty("darkening_" + std::to_string(n), std::to_string(mean));
  }
}

// 2^26 samples of one pixel: a float sum would stop at 2^24. The wedge of 60 degrees has AO (1 - 1/2)/2 =
// 0.25.
TEST(HardCasesOnce, ManySamplesOnOnePixelDoNotDrift) {
  const Case corner(wedge(float(std::numbers::pi / 3), 1e4f));
  constexpr std::uint32_t directions = 1u << 26;
  const Film film = corner.probe(Traversal::automatic, {corner.point({1, 0, 0}, {0, 1, 0})}, directions);
  EXPECT_EQ(film.replicates[0], directions);
  EXPECT_NEAR(film.value(0), 0.25, 5 * std::sqrt(0.1875 / directions) + 1e-4);
  // The variance is that of a frequency, counted without loss.
  EXPECT_NEAR(film.variance(0) * directions, 0.1875, 1e-3);
}

// Ten million triangles around the camera: exactly 0. Takes some GiB and most of a minute, hence the long
// mode alone; says what it took.
TEST(HardCasesOnce, TenMillionTriangles) {
  if (!long_mode()) GTEST_SKIP() << "in the long mode alone";
  const auto start = std::chrono::steady_clock::now();
  const auto lap = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  TriangleMesh star = spiky_star(1582, 0.9f);
  const std::size_t triangles = star.triangles.size();
  ASSERT_GE(triangles, 10'000'000u);
  const double made = lap();
  Case inside(std::move(star));
  const double built = lap();
  inside.scene.camera = {{0.1f, 0.05f, 0.02f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 60};
  inside.scene.width = inside.scene.height = 64;
  inside.scene.spp = 64;
  const Film film = inside.render(Traversal::automatic);
  const double rendered = lap();
  // Its needles are 0.002 wide at the foot and .9 long: at their tips they are thinner than the offset of a
  // ray's origin, which may then start outside.
  std::uint64_t open = 0;
  for (std::size_t i = 0; i < film.pixels(); ++i) {
    EXPECT_EQ(film.hits[i], 64u);
    open += film.sum[i] >> 32;
  }
  EXPECT_LE(open, 4u) << "of " << 64 * film.pixels() << " rays";
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf(
      "%zu triangles: mesh %.1f s, tree %.1f s, upload, kernels and render %.1f s, at most %.2f GiB\n",
      triangles, made, built - made, rendered - built, double(usage.ru_maxrss) / (1 << 20));
}

// Whatever share of a stream a pixel's camera rays fill, and whether they agree in their directions' signs
// (packets) or straddle an axis: the camera looks along -y.
TEST(HardCasesOnce, TraversalsGiveTheSameBits) {
  for (TriangleMesh mesh : {sphere_on_floor(1, vec3(0)), spiky_star(12, 0.4f), bad_floor(1)}) {
    Case both(std::move(mesh));
    for (const Camera& camera :
         {Camera{{0.4f, 3, 5}, {0, 0.5f, 0}, {0, 1, 0}, 40}, Camera{{0, 4, 0}, {0, 0, 0}, {0, 0, 1}, 50}})
      for (const std::uint32_t spp : {1u, 3u, 16u, 40u}) {
        both.scene.camera = camera;
        both.scene.spp = spp;
        const Film stream = both.render(Traversal::stream);
        for (const Traversal other : {Traversal::portable, Traversal::scalar}) {
          const Film film = both.render(other);
          EXPECT_EQ(stream.sum, film.sum) << spp;
          EXPECT_EQ(stream.sum_square, film.sum_square) << spp;
          EXPECT_EQ(stream.hits, film.hits) << spp;
        }
      }
  }
}

}  // namespace
}  // namespace nook::test
