// Cuts what is asked of the path tracer into batches of equal tasks.
#include <algorithm>

#include "render/batch.hpp"

namespace nook {
namespace {

// One work-item does at most this many camera samples, and traces about this many rays.
constexpr std::uint32_t samples_per_task = 64;
constexpr std::uint32_t directions_per_task = 4096;

}  // namespace

// Tasks in which a pixel has equally many samples, as many as a launch may hold: all pixels' first samples,
// then all pixels' next, so that a stopped render is even.
bool PathTracer::accumulate(std::span<const std::uint32_t> pixels, SampleRange range, std::span<Film> films,
                            const Progress& progress) {
  if (pixels.empty() || range.count == 0) return true;
  const bool by_direction = plan_.replicate_directions;
  const std::uint32_t samples_a_task =
      by_direction ? directions_per_task
                   : std::clamp(directions_per_task / plan_.directions, 1u, samples_per_task);
  const std::uint32_t end = range.first + range.count;
  std::uint32_t first = range.first;
  std::size_t pixel = 0;
  const auto samples_here = [&] { return std::min(samples_a_task, end - first); };
  const auto first_directions_here = [&] { return !by_direction || first == 0; };
  const NextBatch next = [&](Batch& batch) {
    if (first >= end) return false;
    const std::uint32_t samples = samples_here();
    batch.samples = by_direction ? 1 : samples;
    batch.directions = by_direction ? samples : plan_.directions;
    batch.total_directions = plan_.directions;
    batch.first_directions = first_directions_here();
    const std::uint64_t rays_of_task = std::uint64_t(batch.samples) * batch.directions;
    std::uint64_t room = std::max<std::uint64_t>(
        {1, device_.info().compute_units,
         std::min(points_per_launch / batch.samples, rays_per_launch_ / rays_of_task)});
    while (room > 0 && first < end && samples_here() == samples &&
           first_directions_here() == batch.first_directions) {
      const std::size_t stop = std::min(pixels.size(), pixel + std::size_t(room));
      batch.finished.push_back({pixel, stop, {first, samples}});
      room -= stop - pixel;
      for (; pixel < stop; ++pixel)
        batch.tasks.push_back({pixels[pixel], by_direction ? 0 : first, by_direction ? first : 0,
                               nook_uint(batch.tasks.size() * batch.samples)});
      if (pixel == pixels.size()) {
        pixel = 0;
        first += samples;
      }
    }
    return true;
  };
  return run(next, films, progress);
}

Film PathTracer::estimate_points(std::span<const SurfacePoint> points, std::size_t effect,
                                 std::uint32_t directions, const Progress& progress) {
  return std::move(estimate_all(points, directions, progress)[effect]);
}

std::vector<Film> PathTracer::estimate_all(std::span<const SurfacePoint> points, std::uint32_t directions,
                                           const Progress& progress) {
  const std::vector<SurfacePoint> held(points.begin(), points.end());
  const ClBuffer buffer = device_.input(held);
  std::vector<Film> films;
  for (const EffectPlan& planned : plan_.effects)
    films.emplace_back(int(points.size()), 1, planned.sum_scale, planned.square_scale,
                       plan_.replicate_directions ? 1 : directions, planned.extra_planes());
  std::uint32_t direction = 0;
  std::size_t row = 0;
  const NextBatch next = [&](Batch& batch) {
    if (direction >= directions || points.empty()) return false;
    batch.points = buffer.get();
    batch.samples = 1;
    batch.directions = std::min(directions_per_task, directions - direction);
    batch.total_directions = directions;
    batch.first_directions = direction == 0;
    // Tasks of several direction chunks share a launch, so that a single point keeps every thread busy.
    const std::uint64_t room = std::max<std::uint64_t>(64, rays_per_launch_ / batch.directions);
    while (batch.tasks.size() < room && direction < directions &&
           std::min(directions_per_task, directions - direction) == batch.directions &&
           (direction == 0) == batch.first_directions) {
      batch.tasks.push_back({nook_uint(row), 0, direction, nook_uint(row)});
      batch.finished.push_back({row, row + 1, {direction, batch.directions}});
      if (++row == points.size()) {
        row = 0;
        direction += batch.directions;
      }
    }
    return true;
  };
  run(next, films, progress);
  return films;
}

}  // namespace nook
