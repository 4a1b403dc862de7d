#pragma once

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Who looks at the surfaces that effects are estimated at.
enum class Viewer { camera, none };

/// What the mesh's readers warn of, and proportions_warning(), go to stderr, a line each.
void warn_of(const Scene& scene, const TriangleMesh& mesh, Viewer viewer);

/// load_scene_mesh(), and warn_of() it as the scene's camera sees it.
TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes,
                           Instancing instancing = Instancing::copies);

}  // namespace nook
