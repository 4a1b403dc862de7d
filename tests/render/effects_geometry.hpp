#pragma once

#include <cmath>
#include <utility>

#include "points/points.hpp"
#include "ssao_scenes.hpp"
#include "support/rendering.hpp"

namespace nook::test {

/// The plane z = height within +-1000: endless for rays of a few units.
inline TriangleMesh plane_at(float height) {
  TriangleMesh mesh;
  add_quad(mesh, {-1000, -1000, height}, {2000, 0, 0}, {0, 2000, 0});
  return mesh;
}

/// The film of one effect at the origin with normal +z, by `directions` directions.
inline Film estimate_at_origin(const TriangleMesh& mesh, const Effect& effect,
                               std::uint32_t directions = 1u << 16) {
  Scene scene;
  scene.effects = {effect};
  scene.directions = directions;
  scene.sampler = Sampler::independent;
  const SurfacePoint point = surface_point({0, 0, 0}, {0, 0, 1}, {0, 0, 1});
  return Renderer(scene, mesh).tracer().estimate_points({&point, 1}, 0, directions);
}

/// The films of a scene's effects, all of its samples.
inline std::vector<Film> films_of(const Scene& scene, const TriangleMesh& mesh) {
  return Renderer(scene, mesh).films();
}

inline double mean_of(const Film& film) {
  double mean = 0;
  for (std::size_t i = 0; i < film.pixels(); ++i) mean += film.value(i) / double(film.pixels());
  return mean;
}

/// AO of what lies within `distance`.
inline Effect ao_within(float distance) {
  Effect effect;
  effect.max_distance = {DistanceLimit::Kind::value, distance};
  return effect;
}

/// |estimate - expected| within 4 standard errors (two-sided p = 6e-5), and those small enough to mean
/// something.
inline void expect_value(const Film& film, double expected) {
  const double error = std::sqrt(film.variance(0));
  EXPECT_LT(error, 0.005);
  EXPECT_NEAR(film.value(0), expected, 4 * error + 1e-6);
}

}  // namespace nook::test
