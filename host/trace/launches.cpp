// Cuts what is asked of the occlusion tracer into batches of equal tasks.
#include <algorithm>

#include "trace/launch.hpp"

namespace nook {
namespace {

// One work-item does at most this many camera samples, and traces about this many rays.
constexpr std::uint32_t samples_per_task = 64;
constexpr std::uint32_t directions_per_task = 4096;

}  // namespace

// Tasks in which a pixel has equally many samples, as many as a launch may hold: all pixels' first samples,
// then all pixels' next, so that a stopped render is even.
bool OcclusionTracer::accumulate(std::span<const std::uint32_t> pixels, SampleRange range,
                                 std::span<Film> films, const Progress& progress) {
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
  const NextLaunch next = [&](Launch& launch) {
    if (first >= end) return false;
    const std::uint32_t samples = samples_here();
    launch.samples = by_direction ? 1 : samples;
    launch.directions = by_direction ? samples : plan_.directions;
    launch.total_directions = plan_.directions;
    launch.first_directions = first_directions_here();
    const std::uint64_t rays_of_task = std::uint64_t(launch.samples) * launch.directions;
    std::uint64_t room = std::max<std::uint64_t>(
        {1, device_.info().compute_units,
         std::min(points_per_launch / launch.samples, rays_per_launch_ / rays_of_task)});
    while (room > 0 && first < end && samples_here() == samples &&
           first_directions_here() == launch.first_directions) {
      const std::size_t stop = std::min(pixels.size(), pixel + std::size_t(room));
      launch.finished.push_back({pixel, stop, {first, samples}});
      room -= stop - pixel;
      for (; pixel < stop; ++pixel)
        launch.tasks.push_back({pixels[pixel], by_direction ? 0 : first, by_direction ? first : 0,
                                nook_uint(launch.tasks.size() * launch.samples)});
      if (pixel == pixels.size()) {
        pixel = 0;
        first += samples;
      }
    }
    return true;
  };
  return run(next, films, progress);
}

Film OcclusionTracer::estimate_points(std::span<const SurfacePoint> points, std::size_t effect,
                                      std::uint32_t directions, const Progress& progress) {
  return std::move(estimate_all(points, directions, progress)[effect]);
}

std::vector<Film> OcclusionTracer::estimate_all(std::span<const SurfacePoint> points,
                                                std::uint32_t directions, const Progress& progress) {
  return estimate_list(points, 0, 0, directions, progress);
}

std::vector<Film> OcclusionTracer::estimate_randomised(std::span<const SurfacePoint> points,
                                                       std::uint32_t first_row, std::uint32_t count,
                                                       std::uint32_t directions, const Progress& progress) {
  return estimate_list(points, first_row, count, directions, progress);
}

// Randomisation after randomisation, numbered from 1; 0 of them: the seed that the tracer has.
std::vector<Film> OcclusionTracer::estimate_list(std::span<const SurfacePoint> points,
                                                 std::uint32_t first_row, std::uint32_t randomisations,
                                                 std::uint32_t directions, const Progress& progress) {
  const std::vector<SurfacePoint> held(points.begin(), points.end());
  const ClBuffer buffer = device_.input(held);
  const std::uint32_t last = randomisations;
  std::vector<Film> films;
  for (const EffectPlan& planned : plan_.effects)
    films.emplace_back(int(points.size()), int(std::max(1u, last)), planned.sum_scale, planned.square_scale,
                       plan_.replicate_directions ? 1 : directions, planned.extra_planes());
  for (std::size_t e = 0; e < films.size(); ++e) films[e].settings = plan_.effects[e].settings();
  std::uint32_t direction = 0, number = std::min(1u, last);
  std::size_t row = 0;
  const NextLaunch next = [&](Launch& launch) {
    if (direction >= directions || points.empty()) return false;
    launch.points = buffer.get();
    launch.point_count = points.size();
    launch.samples = 1;
    launch.directions = std::min(directions_per_task, directions - direction);
    launch.total_directions = directions;
    launch.first_directions = direction == 0;
    // Tasks of several direction chunks share a launch, so that a single point keeps every thread busy.
    const std::uint64_t room = std::max<std::uint64_t>(64, rays_per_launch_ / launch.directions);
    while (launch.tasks.size() < room && direction < directions &&
           std::min(directions_per_task, directions - direction) == launch.directions &&
           (direction == 0) == launch.first_directions) {
      launch.tasks.push_back({first_row + nook_uint(row), number, direction, nook_uint(row)});
      launch.finished.push_back({row, row + 1, {direction, launch.directions}});
      if (++row < points.size()) continue;
      row = 0;
      if (++number <= last) continue;
      number = std::min(1u, last);
      direction += launch.directions;
    }
    return true;
  };
  run(next, films, progress);
  return films;
}

}  // namespace nook
