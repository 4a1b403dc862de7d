#include "render/point_estimates.hpp"

#include <cmath>

#include "adaptive/quantiles.hpp"
#include "trace/randomisations.hpp"

namespace nook {
namespace {

constexpr double confidence = 0.95;
constexpr float square_scale = 0x1p52f;  // means differ in their fourth digit, and their squares are added

// Another randomisation's samples, as one more replicate of each point.
void add_replicate(Film& whole, const Film& film) {
  for (std::size_t i = 0; i < whole.pixels(); ++i) {
    whole.sum[i] += film.sum[i];
    const double mean = film.value(i);
    whole.sum_square[i] += std::uint64_t(std::llround(mean * mean * double(whole.square_scale)));
    whole.replicates[i] += film.replicates[i] > 0;
    whole.camera_samples[i] += film.camera_samples[i];
    whole.hits[i] += film.hits[i];
    for (std::size_t plane = 0; plane < whole.extra.size(); ++plane)
      whole.extra[plane][i] += film.extra[plane][i];
  }
}

}  // namespace

std::uint32_t randomisations_at_points(Sampler sampler, std::uint32_t directions) {
  if (sampler == Sampler::independent) return 1;
  for (std::uint32_t count = 16; count >= 8; --count)
    if (directions % count == 0) return count;
  return 1;
}

std::vector<Film> estimate_at_points(OcclusionTracer& tracer, const Plan& plan,
                                     std::span<const SurfacePoint> points, std::uint32_t directions,
                                     const OcclusionTracer::Progress& progress) {
  const std::uint32_t count = randomisations_at_points(plan.sampler, directions);
  tracer.set_samples(plan.spp, plan.seed);  // whatever an earlier call left
  if (count == 1) return tracer.estimate_all(points, directions, progress);
  std::vector<Film> whole;
  for (const EffectPlan& planned : plan.effects)
    whole.emplace_back(int(points.size()), 1, planned.sum_scale, square_scale, directions / count,
                       planned.extra_planes());
  for (std::uint32_t r = 0; r < count; ++r) {
    tracer.set_samples(plan.spp, Randomisations::seed_of(plan.seed, r));
    const std::vector<Film> films = tracer.estimate_all(points, directions / count, progress);
    for (std::size_t e = 0; e < whole.size(); ++e) add_replicate(whole[e], films[e]);
  }
  return whole;
}

double standard_error(const Film& film, std::size_t point, double weight_bound) {
  const std::uint32_t replicates = film.replicates[point];
  if (replicates == 0) return 0;
  const double error = replicates > 1 ? std::sqrt(film.variance(point)) : 0;
  const double normal = normal_quantile(confidence);
  if (error > 0) return error * student_quantile(confidence, replicates - 1) / normal;
  return 3 * weight_bound / (normal * double(replicates) * double(film.per_replicate));
}

}  // namespace nook
