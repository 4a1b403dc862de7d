#pragma once

#include "support/kernels.hpp"
#include "support/oracle.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::test {

/// Renders with the product's whole path (plan, tree, kernels) and keeps what it needs alive.
class Renderer {
 public:
  Renderer(const Scene& scene, const TriangleMesh& mesh,
           const OcclusionTracer::KernelSource& source = kernel_source,
           Traversal traversal = Traversal::automatic);

  /// The films of all effects, with all of the plan's samples.
  std::vector<Film> films();
  /// The first effect's picture with the variance of each pixel.
  ReferenceImage picture();
  /// AO or RO at points that may lie on surfaces, `directions` directions each.
  Film at_points(std::vector<SurfacePoint> points, std::uint32_t directions);
  /// The same with the spread of randomisations, as probe and bakes have it.
  Film with_errors(std::vector<SurfacePoint> points, std::uint32_t directions);
  const RenderCounters& counters() const { return tracer_.counters(); }
  const Plan& plan() const { return plan_; }
  /// For what the above does not do.
  OcclusionTracer& tracer() { return tracer_; }

 private:
  TriangleMesh mesh_;
  Plan plan_;
  Bvh bvh_;
  OcclusionTracer tracer_;
};

/// The mean of `replicates` pictures of different seeds, and its variance as their spread shows it: for point
/// sets, whose samples are not independent.
ReferenceImage replicated_picture(Scene scene, const TriangleMesh& mesh, int replicates);

}  // namespace nook::test
