#pragma once

#include <string>

#include "device/program_cache.hpp"
#include "plan/plan.hpp"

namespace nook {

/// One program to build: a kernel file specialised by its options. The device may add how it traverses;
/// nothing else is added.
struct KernelPlan {
  std::string file;   ///< "stage/occlusion.cl"
  std::string entry;  ///< "occlusion"
  BuildOptions options;
};

/// Finds the surface points of camera rays.
KernelPlan primary_kernel(const Plan& plan);

/// Estimates one effect at surface points. Only what this effect asks for is in the options: another effect
/// of the scene changes neither this program nor its place in the cache.
KernelPlan occlusion_kernel(const Plan& plan, const EffectPlan& effect);

}  // namespace nook
