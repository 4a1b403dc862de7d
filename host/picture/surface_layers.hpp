#pragma once

#include <span>

#include "image/image.hpp"
#include "kernels/shared/surface_point.h"
#include "plan/plan.hpp"

namespace nook {

/// Appends the layers of type normal, position and depth: PREFIX.X, .Y, .Z, or PREFIX.Z for a depth. Normals
/// are shading normals in world space, positions are in world units; 0 where nothing is hit. Depth is along
/// the view axis, infinity where nothing is hit. The main layer is R, G, B as well: a vector's components, or
/// a depth three times. `surface`: one point per pixel of the window, row-major.
void add_surface_layers(const Plan& plan, std::span<const SurfacePoint> surface,
                        std::vector<Channel>& channels);

}  // namespace nook
