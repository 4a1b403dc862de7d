#pragma once

#include "image/image.hpp"
#include "mesh/triangle_mesh.hpp"
#include "render/picture.hpp"
#include "report/run_record.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Draws the screen-space effects of record.plan: appends their channels to `image` and a record each to
/// record.ssao. If they are all there is, `image` is made here, with the normal, position, depth and alpha
/// channels of `aovs`, and the record's device is OpenGL's. Each frame is drawn `frames` times, for timing.
/// Throws Error(usage) for channels that SSAO does not have, and what SsaoRenderer throws.
void draw_ssao(const Scene& scene, const TriangleMesh& mesh, const AovRequest& aovs, unsigned frames,
               RunRecord& record, Image& image);

/// One line to stderr for each screen-space effect drawn: its time, and that of its passes.
void announce_ssao(const RunRecord& record);

}  // namespace nook
