#pragma once

#include "app/checkpoints.hpp"
#include "app/progress.hpp"
#include "render/adaptive.hpp"
#include "render/deadline.hpp"
#include "render/session.hpp"
#include "report/run_record.hpp"

namespace nook {

/// What a render under way is watched by.
struct RunControl {
  PathTracer& tracer;
  CheckpointWriter& writer;
  Deadline deadline;
  ProgressMode mode = ProgressMode::none;
};

/// Takes the samples of a share: all of them, or, with `doubling`, 1, 2, 4, ... of every pixel, so that the
/// picture is even whenever the deadline ends it. Whatever ends it early, what is finished stays on disk.
/// Throws Error(interrupted).
void run_to_samples(Session& session, const SampleBox& share, bool doubling, RunControl control);

/// Runs to the error or the deadline, likewise.
AdaptiveResult run_to_error(AdaptiveRender& render, RunControl control);

/// What a render that ended by time has reached, by the films' own variances.
ErrorRecord error_of(std::span<const Film> films);

}  // namespace nook
