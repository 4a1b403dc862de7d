#pragma once

#include <cstdint>
#include <string>

namespace nook {

/// How far a run is.
struct RunProgress {
  std::uint64_t samples = 0;  ///< camera samples taken by this run
  std::uint64_t total = 1;    ///< that it will take, at least 1; an estimate where a stop rule decides
  std::uint64_t rays = 0;     ///< camera and occlusion rays traced by this run
  double error = 0;           ///< with a stop rule: root mean square of the standard errors; 0: not known yet
  double share_done = 0;      ///< with a stop rule: of the pixels
};

/// What watches a run and may end it. It is called after each launch (of at most
/// OcclusionTracer::most_rays_per_launch rays), on the thread that runs.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  virtual void progress(const RunProgress&) {}
  /// True ends the run: what is finished is kept, and Error(interrupted) thrown.
  virtual bool cancelled() { return false; }
  /// Something went wrong that the run survives, in one line.
  virtual void warn(const std::string&) {}
  /// The run is over, however it ended: nothing of the above follows.
  virtual void end() {}
};

}  // namespace nook
