#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kernels/shared/surface_point.h"
#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Leaves a scene the one effect to estimate at points: its first, or of the type asked for the first, or
/// else its first effect turned into one of that type with that type's sampling and distance. Throws
/// Error(usage) where that is no traced one.
void choose_effect_at_points(std::optional<EffectKind> asked, Scene& scene);

/// That scene with `directions` samples at each point, and without what only a picture has. Throws
/// Error(usage), Error(scene) for what points cannot have: a lobe by material, occluders of their own group.
Scene scene_at_points(Scene scene, std::uint32_t directions);

/// Surface points of arrays of x, y, z each, in the mesh's file's coordinates, as load_points() makes them of
/// a file's rows, and off the triangles that they lie on. views: towards the viewer, or empty. Normals and
/// views are normalised. Throws Error(usage) "normals: row 3 is zero", and for sizes that differ.
std::vector<SurfacePoint> points_of_arrays(std::span<const double> positions, std::span<const double> normals,
                                           std::span<const double> views, const TriangleMesh& mesh);

}  // namespace nook
