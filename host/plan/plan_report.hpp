#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bvh/bvh.hpp"
#include "plan/kernel_plan.hpp"
#include "plan/plan.hpp"

namespace nook {

/// A pass over the picture or the mesh, and the rays it traces at most.
struct PassReport {
  std::string name, what;
  std::uint64_t rays = 0;
};

/// A buffer that is uploaded.
struct BufferReport {
  std::string name;
  std::uint64_t bytes = 0;
};

/// What a plan will do and what it leaves out, in words: `nook plan`.
struct PlanReport {
  std::vector<std::pair<std::string, std::string>> picture;  ///< camera, ground, background: name and words
  std::vector<PassReport> passes;
  std::vector<KernelPlan> kernels;     ///< each program once
  std::vector<BufferReport> buffers;   ///< for OpenCL; their sum is what a run's record counts on upload
  std::vector<std::string> libraries;  ///< loaded when needed, by their task
  std::vector<std::string> left_out;   ///< "no tree: ..."
};

/// `mesh` as loaded with needed_attributes(scene). `bvh`: of the mesh, or null if the plan needs none.
PlanReport report_plan(const Scene& scene, const Plan& plan, const TriangleMesh& mesh, const Bvh* bvh);

}  // namespace nook
