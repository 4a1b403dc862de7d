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

/// Takes the samples of a share: all of them, or, with `doubling`, 1, 2, 4, ... of every pixel, so that the
/// picture is even whenever the deadline ends it. Whatever ends it early, what is finished stays on disk.
/// Throws Error(interrupted) if the observer cancels it.
void run_to_samples(Session& session, const SampleBox& share, bool doubling, RunControl control);

/// Runs to the error or the deadline, likewise.
AdaptiveResult run_to_error(AdaptiveRender& render, RunControl control);

}  // namespace nook
