#pragma once

#include "mesh/obj_loader.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Everything that the scene's rays may meet, as one mesh: its mesh files, the instances of them, and the
/// ground. Instances are copies: a file is read once, and each copy has triangles of its own. Throws
/// Error(scene).
TriangleMesh load_scene_mesh(const Scene& scene, const MeshAttributes& attributes = {});

}  // namespace nook
