#include "render/point_estimates.hpp"

#include <algorithm>
#include <cmath>

#include "adaptive/quantiles.hpp"
#include "trace/randomisations.hpp"

namespace nook {
namespace {

constexpr double confidence = 0.95;
const double normal = normal_quantile(confidence);
// Samples of the largest weight that may have gone unseen, and hits of the usual weight, and how
// many hits are few (standard_error()).
constexpr double unseen_samples = 0.1, rare_hits = 2.5, few_hits = 20;
constexpr float square_scale = 0x1p52f;  // means differ in their fourth digit, and their squares are added

// Of the points that one launch may have results of: a point has as many as randomisations.
constexpr std::uint32_t most_results = 1u << 20;

// Σ x² / bound of the samples x, in the fixed point of their sum: what tells how few of them carry most of
// the weight. With `bound` the sums of squares fit where the sums do.
std::uint64_t squares_of(const Film& film, std::size_t i, double bound) {
  return std::uint64_t(std::llround(double(film.sum_square[i]) / film.square_scale / bound * film.sum_scale));
}

// Another randomisation's samples, pixels [first, first + count) of `film`, as one more replicate of the
// points from `point` on.
void add_replicate(Film& whole, std::size_t point, const Film& film, std::size_t first, std::size_t count,
                   double bound) {
  for (std::size_t from = first; from < first + count; ++from, ++point) {
    whole.sum[point] += film.sum[from];
    whole.kept[0][point] += squares_of(film, from, bound);
    const double mean = film.value(from);
    whole.sum_square[point] += std::uint64_t(std::llround(mean * mean * double(whole.square_scale)));
    whole.replicates[point] += film.replicates[from] > 0;
    whole.camera_samples[point] += film.camera_samples[from];
    whole.hits[point] += film.hits[from];
    for (std::size_t plane = 0; plane < whole.extra.size(); ++plane)
      whole.extra[plane][point] += film.extra[plane][from];
  }
}

}  // namespace

std::uint32_t randomisations_at_points(const Plan& plan, std::uint32_t directions) {
  if (!plan.point_set.empty()) return directions / std::uint32_t(plan.point_set.size());
  if (plan.sampler == Sampler::independent) return 1;
  for (std::uint32_t count = 16; count >= 8; --count)
    if (directions % count == 0) return count;
  return 1;
}

std::vector<Film> estimate_at_points(OcclusionTracer& tracer, const Plan& plan,
                                     std::span<const SurfacePoint> points, std::uint32_t directions,
                                     const OcclusionTracer::Progress& progress) {
  const std::uint32_t count = randomisations_at_points(plan, directions);
  tracer.set_samples(plan.spp, plan.seed);  // whatever an earlier call left
  std::vector<Film> whole;
  if (count == 1) {
    whole = tracer.estimate_all(points, directions, progress);
    for (std::size_t e = 0; e < whole.size(); ++e) {
      whole[e].kept.assign(1, std::vector<std::uint64_t>(points.size()));
      for (std::size_t i = 0; i < points.size(); ++i)
        whole[e].kept[0][i] = squares_of(whole[e], i, plan.effects[e].weight_bound);
    }
    return whole;
  }
  for (const EffectPlan& planned : plan.effects) {
    whole.emplace_back(int(points.size()), 1, planned.sum_scale, square_scale, directions / count,
                       planned.extra_planes());
    whole.back().kept.assign(1, std::vector<std::uint64_t>(points.size()));
  }
  // All randomisations of some points together: a launch costs more than a point's directions.
  const bool together = plan.replicate_directions;
  const std::size_t most = together ? std::max(1u, most_results / count) : points.size();
  for (std::size_t first = 0; first < points.size(); first += most) {
    const auto some = points.subspan(first, std::min(most, points.size() - first));
    for (std::uint32_t r = 0; r < count; r += together ? count : 1) {
      if (!together) tracer.set_samples(plan.spp, Randomisations::seed_of(plan.seed, r));
      const std::vector<Film> films = together ? tracer.estimate_randomised(some, std::uint32_t(first), count,
                                                                            directions / count, progress)
                                               : tracer.estimate_all(some, directions / count, progress);
      for (std::size_t e = 0; e < whole.size(); ++e)
        for (std::size_t from = 0; from < films[e].pixels(); from += some.size())
          add_replicate(whole[e], first, films[e], from, some.size(), plan.effects[e].weight_bound);
    }
  }
  return whole;
}

double standard_error(const Film& film, std::size_t point, double weight_bound) {
  const std::uint32_t replicates = film.replicates[point];
  if (replicates == 0) return 0;
  const double n = double(replicates) * film.per_replicate, mean = film.value(point);
  const double widened = replicates > 1 ? student_quantile(confidence, replicates - 1) / normal : 1;
  const double scale = double(film.sum_scale) / weight_bound;
  const double sum = double(film.sum[point]) / film.sum_scale, squares = double(film.kept[0][point]) / scale,
               seen = unseen_samples * weight_bound;
  const double c = std::clamp((squares + seen * weight_bound) / (sum + seen), mean, weight_bound);
  const double share = mean / c, away = 1 - 2 * share;
  const double effective = n * share * (1 - share) / few_hits;
  return std::sqrt(widened * widened * film.variance(point) +
                   rare_hits * away * away * c * c / (n * n * (1 + effective * effective)));
}

}  // namespace nook
