#pragma once

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What the mesh's readers warn of goes to stderr, a line each.
void warn_of(const TriangleMesh& mesh);

/// load_scene_mesh(), and warn_of() it.
TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes,
                           Instancing instancing = Instancing::copies);

}  // namespace nook
