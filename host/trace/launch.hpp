#pragma once

#include "trace/occlusion_tracer.hpp"

namespace nook {

/// What one launch does. Internal to the occlusion tracer: launches.cpp cuts work into them,
/// launch_queue.cpp launches them.
struct OcclusionTracer::Launch {
  std::vector<Task> tasks;
  std::uint32_t samples = 1;           // camera samples in each task
  std::uint32_t directions = 1;        // directions in each task's camera sample
  std::uint32_t total_directions = 1;  // of a camera sample in the whole render
  cl_mem points = nullptr;             // given; otherwise `primary` makes them
  std::size_t point_count = 0;         // of those given: films have so many pixels for each randomisation
  bool first_directions = true;        // the tasks hold their camera samples' first directions
  std::vector<Finished> finished;      // what the tasks amount to
};

// A launch is bounded by the surface points it holds (64 bytes each, two launches under way) and by its rays,
// so that progress, time limits and interrupts are seen often; it stays far above the cost of an enqueue
// (25-80 µs, on PoCL 0.13 ms more): see OcclusionTracer::most_rays_per_launch.
constexpr std::uint64_t points_per_launch = 1u << 19;

}  // namespace nook
