#pragma once

#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// A right-handed frame about a mesh: `front` is the side that view "front" sees, `right` what is then at the
/// right. About y the front is +z, about z -y (as in Blender), about x +z; unit vectors.
struct Sides {
  dvec3 up{0, 1, 0}, front{0, 0, 1}, right{1, 0, 0};
};
Sides sides_about(const vec3& up);

/// The camera of a scene that frames its mesh, in the file's coordinates: along scene.view, as near as the
/// projections of all vertices of `mesh` (less a ground that was added to it) leave scene.margin of the
/// picture's width and height free on each side, and so that they are in the middle in both directions. In
/// the direction that decides they touch both margins. `at` is the point of the line of sight that is as deep
/// as the middle of the mesh's bounds.
Camera framing_camera(const Scene& scene, const TriangleMesh& mesh);

/// The cameras of `count` pictures along a full turn: of picture i, azimuth + 360 i / count degrees. They are
/// framed together: the axis of the turn goes through the middle of the mesh's bounds, the eye stays as far
/// from it, and no vertex leaves the margins wherever it is turned to.
std::vector<Camera> framing_turn(const Scene& scene, const TriangleMesh& mesh, unsigned count);

}  // namespace nook
