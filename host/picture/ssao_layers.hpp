#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "mesh/triangle_mesh.hpp"
#include "picture/picture.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "ssao/ssao.hpp"

namespace nook {

/// A screen-space effect of a run: what was drawn, and the fastest time of each pass over its frames.
struct SsaoRecord {
  std::string name;  ///< of its layer, or its type
  SsaoSettings settings;
  SsaoPlan plan;
  unsigned frames = 1;
  std::vector<SsaoTiming> passes;
  double seconds_per_frame = 0;  ///< of the fastest frame
};

/// What was drawn of a plan, and by what.
struct SsaoLayers {
  std::vector<SsaoRecord> effects;  ///< in the plan's order
  std::string device, version;      ///< of OpenGL
  std::uint64_t mesh_bytes = 0;     ///< uploaded
  double seconds = 0;               ///< all that it took
};

/// Draws the screen-space effects of `plan`, each frame `frames` times, for timing, and appends their
/// channels to `image`. If they are all there is (!plan.needs_opencl()), `image` is made here, with the
/// normal, position, depth and alpha channels of `aovs`. Throws Error(usage) for channels that SSAO does not
/// have, and what SsaoRenderer throws.
SsaoLayers draw_ssao(const Scene& scene, const TriangleMesh& mesh, const Plan& plan, const AovRequest& aovs,
                     unsigned frames, Image& image);

}  // namespace nook
