#pragma once

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// load_scene_mesh(); what its readers warn of goes to stderr, a line each.
TriangleMesh load_and_warn(const Scene& scene, const MeshAttributes& attributes,
                           Instancing instancing = Instancing::copies);

}  // namespace nook
