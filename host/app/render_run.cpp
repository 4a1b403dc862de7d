#include "app/render_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/interrupt.hpp"
#include "base/error.hpp"

namespace nook {
namespace {

std::uint64_t rays_of(const PathTracer& tracer) {
  return tracer.counters().camera_rays + tracer.counters().occlusion_rays;
}

// After each launch.
bool go_on(Session& session, RunControl& control) {
  control.writer.update(session);
  const bool out_of_time = control.deadline.reached(rays_of(control.tracer));
  control.tracer.limit_launches(control.deadline.launch_rays(PathTracer::most_rays_per_launch));
  return !interrupted() && !out_of_time;
}

// Calls `run`, which returns whether it is finished; what it leaves unfinished is kept.
template <class Run>
void keeping(Session& session, RunControl& control, ProgressReporter& progress, Run run) {
  control.tracer.limit_launches(control.deadline.launch_rays(PathTracer::most_rays_per_launch));
  bool finished = false;
  try {
    finished = run();
  } catch (const Error& e) {
    progress.finish();
    control.writer.write(session);
    throw Error(e.code(), e.what() + control.writer.what_is_kept(session));
  }
  progress.finish();
  if (finished || !interrupted()) return;
  control.writer.write(session);
  throw Error(ExitCode::interrupted, "interrupted" + control.writer.what_is_kept(session));
}

}  // namespace

Session::Schedule doublings() {
  return [](const Session& session) -> SampleBoxes {
    const SampleBox all = session.share({0, 1});
    const std::uint64_t taken =
        session.samples_held() / std::max<std::uint64_t>(1, all.pixel_end - all.pixel_begin);
    return {{all.pixel_begin, all.pixel_end, 0,
             std::uint32_t(std::min<std::uint64_t>(all.end, std::max<std::uint64_t>(1, 2 * taken)))}};
  };
}

Session::Schedule all_of_each(const Session& session, std::span<const std::uint32_t> camera_rays) {
  SampleBoxes boxes;
  const std::uint32_t pixels = session.share({0, 1}).pixel_end;
  for (std::uint32_t begin = 0, end; begin < pixels; begin = end) {
    const std::uint32_t rays = camera_rays[session.film_index(begin)];
    for (end = begin + 1; end < pixels && camera_rays[session.film_index(end)] == rays;) ++end;
    if (rays > 0) boxes.push_back({begin, end, 0, rays});
  }
  return [boxes](const Session&) { return boxes; };
}

bool has_first_samples(const Session& session) {
  const std::vector<std::uint32_t>& taken = session.films().front().camera_samples;
  return subtract(session.held(), all_of_each(session, taken)(session)).empty();
}

void run_schedule(Session& session, const Session::Schedule& schedule, std::uint64_t total,
                  RunControl control) {
  const std::uint64_t held_before = session.samples_held(), rays_before = rays_of(control.tracer);
  ProgressReporter progress(control.mode, total);
  keeping(session, control, progress, [&] {
    return session.run(schedule, [&] {
      progress.update(session.samples_held() - held_before, rays_of(control.tracer) - rays_before);
      return go_on(session, control);
    });
  });
}

AdaptiveResult run_to_error(AdaptiveRender& render, RunControl control) {
  Session& session = render.session();
  const std::uint64_t held_before = session.samples_held(), rays_before = rays_of(control.tracer);
  ProgressReporter progress(control.mode, 1);
  AdaptiveResult result;
  keeping(session, control, progress, [&] {
    result = render.run([&](const AdaptiveProgress& now) {
      const std::uint64_t done = now.samples_done - held_before;
      progress.set_total(done + std::uint64_t(now.samples_left));
      if (now.error > 0)
        progress.set_note(
            fmt::format("error {:.4f}, {:.0f} % of the pixels done", now.error, 100 * now.share_done));
      progress.update(done, rays_of(control.tracer) - rays_before);
      return go_on(session, control);
    });
    return !result.stopped_early;
  });
  session.part().finished = result.met();
  return result;
}

ErrorRecord error_of(std::span<const Film> films) {
  ErrorRecord error;
  double square = 0, seen = 0;
  for (const Film& film : films)
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (film.hits[i] == 0) continue;
      const double variance = film.variance(i);
      square += variance;
      seen += 1;
      error.worst = std::max(error.worst, std::sqrt(variance));
    }
  error.reached = seen > 0 ? std::sqrt(square / seen) : 0;
  error.share_done = 1;
  return error;
}

}  // namespace nook
