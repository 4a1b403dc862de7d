// Ten million triangles around the camera: some GiB and most of a minute, hence in the long mode alone
// (NOOK_TEST_LONG=1).
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "hard_case.hpp"
#include "support/mutants.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

/// How often the closed mesh goes around the point: the sum of its triangles' solid angles over 4 pi (Van
/// Oosterom and Strackee 1983), in double precision. +-1 inside, 0 outside.
double winding_number(const TriangleMesh& mesh, const dvec3& point) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const dvec3 a = dvec3(mesh.positions[triangle[0]]) - point,
                b = dvec3(mesh.positions[triangle[1]]) - point,
                c = dvec3(mesh.positions[triangle[2]]) - point;
    const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                          x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  }
  return sum / (4 * std::numbers::pi);
}

/// Where the rays of a pixel's camera samples start: surface_points() of a tracer whose points are not the
/// pixel's centre but its samples, by number.
std::vector<SurfacePoint> sampled_points(const Case& scene, std::uint32_t pixel, std::uint32_t spp) {
  const auto by_number = [&](const std::string& file) {
    const std::string source = kernel_source(file);
    if (file != "stage/primary.cl") return source;
    return mutate(
        mutate(source, "sample[k] = task.first_sample + (begin + k) % p.samples;", "sample[k] = task.point;"),
        "camera_directions(&camera, pixel, sample, count, &p,",
        "EstimatorParams all = p;\n    all.total_samples = " + std::to_string(spp) +
            "u;\n    camera_directions(&camera, pixel, sample, count, &all,");
  };
  return scene.tracer(Traversal::stream, by_number).surface_points(std::vector<std::uint32_t>(spp, pixel));
}

class TenMillionTriangles : public testing::Test {
 protected:
  double lap() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// From inside no ray gets out. Its needles are .002 wide at the foot and .9 long: towards their tips they are
// thinner than the offset of a ray's origin, and the few rays that start there start outside.
TEST_F(TenMillionTriangles, OnlyRaysThatStartOutsideGetOut) {
  if (!long_mode()) GTEST_SKIP() << "in the long mode alone";
  TriangleMesh star = spiky_star(1582, 0.9f);
  const std::size_t triangles = star.triangles.size();
  ASSERT_GE(triangles, 10'000'000u);
  const double made = lap();
  Case inside(std::move(star));
  const double built = lap();
  constexpr std::uint32_t spp = 64;
  inside.scene.camera = {{0.1f, 0.05f, 0.02f}, {1, 0.3f, 0.2f}, {0, 1, 0}, 60};
  inside.scene.width = inside.scene.height = 64;
  inside.scene.spp = spp;
  const Film film = inside.render(Traversal::stream);
  std::printf("%zu triangles: mesh %.1f s, tree %.1f s, upload, kernels and render %.1f s\n", triangles, made,
              built - made, lap() - built);
  for (const Traversal other : {Traversal::portable, Traversal::scalar})
    EXPECT_EQ(inside.render(other).sum, film.sum);

  EXPECT_NEAR(std::abs(winding_number(inside.mesh(), dvec3(inside.scene.camera.eye))), 1, 1e-6);
  OcclusionTracer tracer = inside.tracer(Traversal::stream);
  unsigned open = 0;
  for (std::uint32_t pixel = 0; pixel < film.pixels(); ++pixel) {
    EXPECT_EQ(film.hits[pixel], spp);
    if (film.sum[pixel] == 0) continue;
    const std::vector<SurfacePoint> points = sampled_points(inside, pixel, spp);
    for (std::uint32_t sample = 0; sample < spp; ++sample) {
      std::vector<Film> one = tracer.make_films();
      tracer.accumulate(std::vector{pixel}, {sample, 1}, one);
      if (one[0].sum[pixel] == 0) continue;
      ++open;
      const float* origin = points[sample].origin;
      const double around = winding_number(inside.mesh(), dvec3(origin[0], origin[1], origin[2]));
      EXPECT_NEAR(around, 0, 1e-6) << "pixel " << pixel << ", sample " << sample;
    }
  }
  EXPECT_LE(open, 4u);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%u of %u rays start outside and get out; at most %.2f GiB\n", open,
              unsigned(spp * film.pixels()), double(usage.ru_maxrss) / (1 << 20));
}

}  // namespace
}  // namespace nook::test
