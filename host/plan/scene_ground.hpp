#pragma once

#include <optional>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Adds the scene's ground to its mesh. What the scene leaves open: it stands across y, or, of a camera that
/// frames the mesh, across the axis nearest to its up; it is at the lowest point of the mesh; it reaches 20
/// bounding radii to all sides, or, of a camera that frames the mesh, twice as far as the picture shows it,
/// from 20 to 1000 radii. A camera that frames the mesh and looks at the ground from below, or a mesh that
/// lies flat on it, has none: TriangleMesh::why_no_ground says so.
void add_ground(const Scene& scene, TriangleMesh& mesh);

/// The ground of a mesh that add_ground() has seen, with everything settled: whatever camera comes, it is the
/// same to the bit. Unset if there is none.
std::optional<Ground> settled_ground(const TriangleMesh& mesh);

}  // namespace nook
