#pragma once

#include "adaptive/adaptive.hpp"
#include "render/checkpoint_writer.hpp"
#include "render/observer.hpp"
#include "trace/deadline.hpp"
#include "trace/session.hpp"

namespace nook {

/// What a run of a session works with, and what it is watched by.
struct RunControl {
  OcclusionTracer& tracer;
  CheckpointWriter& writer;
  Deadline deadline;
  RunObserver& observer;
};

/// Works until the schedule has nothing new, or the deadline ends it; `total`: the samples that it will take.
/// Whatever ends it early, what is finished stays on disk. Throws Error(interrupted).
void run_schedule(Session& session, const Session::Schedule& schedule, std::uint64_t total,
                  RunControl control);

/// 1, 2, 4, ... samples of every pixel, so that the picture is even whenever the deadline ends it.
Session::Schedule doublings();

/// The samples [0, camera_rays[i]) of pixel i of the window.
Session::Schedule all_of_each(const Session& session, std::span<const std::uint32_t> camera_rays);

/// Whether each pixel has its first samples, and no others.
bool has_first_samples(const Session& session);

/// Runs to the error or the deadline, likewise.
AdaptiveResult run_to_error(AdaptiveRender& render, RunControl control);

}  // namespace nook
