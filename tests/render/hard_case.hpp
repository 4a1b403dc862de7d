#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bvh/bvh.hpp"
#include "device/kernel_source.hpp"
#include "hard_meshes.hpp"
#include "points/points.hpp"
#include "support/kernels.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {

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
  OcclusionTracer tracer(Traversal traversal,
                         const OcclusionTracer::KernelSource& source = kernel_source) const {
    return OcclusionTracer(device(), make_plan(scene, mesh_), mesh_, bvh_, source, traversal);
  }
  Film render(Traversal traversal, const OcclusionTracer::KernelSource& source = kernel_source) const {
    const Plan plan = make_plan(scene, mesh_);
    OcclusionTracer whole = tracer(traversal, source);
    std::vector<Film> films = whole.make_films();
    whole.accumulate(pixels_in_order(plan.window, plan.width), {0, plan.samples_per_pixel()}, films);
    EXPECT_EQ(whole.counters().rejected, 0u);
    return std::move(films[0]);
  }
  Film probe(Traversal traversal, const std::vector<SurfacePoint>& points, std::uint32_t directions,
             std::uint64_t rejected = 0) const {
    Scene at_points = scene;
    at_points.spp = 1;
    OcclusionTracer probes(device(), make_plan(at_points, mesh_), mesh_, bvh_, kernel_source, traversal);
    Film film = probes.estimate_points(points, 0, directions);
    EXPECT_EQ(probes.counters().rejected, rejected);
    return film;
  }
  SurfacePoint point(vec3 position, vec3 normal, vec3 view = vec3(0)) const {
    return surface_point(position, normal, view);
  }
  const TriangleMesh& mesh() const { return mesh_; }
  const Bvh& bvh() const { return bvh_; }

  Scene scene;

 private:
  TriangleMesh mesh_;
  Bvh bvh_;
};

/// A hard case on the kernels that users run, once with each traversal.
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

inline std::string traversal_name(const testing::TestParamInfo<Traversal>& traversal) {
  return traversal.param == Traversal::stream     ? "stream"
         : traversal.param == Traversal::portable ? "portable"
                                                  : "scalar";
}

inline auto every_traversal() {
  return testing::Values(Traversal::stream, Traversal::portable, Traversal::scalar);
}

}  // namespace nook::test
