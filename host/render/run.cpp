#include "render/run.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace nook {
namespace {

std::uint64_t rays_of(const OcclusionTracer& tracer) {
  return tracer.counters().camera_rays + tracer.counters().occlusion_rays;
}

// After each launch.
bool go_on(Session& session, RunControl& control) {
  if (const std::string failure = control.writer.update(session); !failure.empty())
    control.observer.warn(failure + "; the render goes on");
  const bool out_of_time = control.deadline.reached(rays_of(control.tracer));
  control.tracer.limit_launches(control.deadline.launch_rays(OcclusionTracer::most_rays_per_launch));
  return !control.observer.cancelled() && !out_of_time;
}

// Calls `run`, which returns whether it is finished; what it leaves unfinished is kept.
template <class Run>
void keeping(Session& session, RunControl& control, Run run) {
  control.tracer.limit_launches(control.deadline.launch_rays(OcclusionTracer::most_rays_per_launch));
  bool finished = false;
  try {
    finished = run();
  } catch (const Error& e) {
    control.observer.end();
    control.writer.write(session);
    throw Error(e, control.writer.what_is_kept(session));
  }
  control.observer.end();
  if (finished || !control.observer.cancelled()) return;
  control.writer.write(session);
  throw Error(ErrorKind::interrupted, "interrupted" + control.writer.what_is_kept(session));
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
  RunProgress now;
  now.total = std::max<std::uint64_t>(1, total);
  keeping(session, control, [&] {
    return session.run(schedule, [&] {
      now.samples = session.samples_held() - held_before;
      now.rays = rays_of(control.tracer) - rays_before;
      control.observer.progress(now);
      return go_on(session, control);
    });
  });
}

AdaptiveResult run_to_error(AdaptiveRender& render, RunControl control) {
  Session& session = render.session();
  const std::uint64_t held_before = session.samples_held(), rays_before = rays_of(control.tracer);
  AdaptiveResult result;
  keeping(session, control, [&] {
    result = render.run([&](const AdaptiveProgress& adaptive) {
      RunProgress now;
      now.samples = adaptive.samples_done - held_before;
      now.total = std::max<std::uint64_t>(1, now.samples + std::uint64_t(adaptive.samples_left));
      now.rays = rays_of(control.tracer) - rays_before;
      now.error = adaptive.error;
      now.share_done = adaptive.share_done;
      control.observer.progress(now);
      return go_on(session, control);
    });
    return !result.stopped_early;
  });
  session.part().finished = result.met();
  return result;
}

}  // namespace nook
