#pragma once

#include "kernels/shared/camera.h"
#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The camera of a scene, in the file's coordinates: its own, or the automatic one, which frames the mesh.
Camera resolve_camera(const Scene& scene, const TriangleMesh& mesh);

/// The same camera in the coordinates of a mesh in memory.
Camera in_frame(Camera camera, const Frame& frame);

/// The camera as the kernels use it. `scene` must be validated; the automatic camera frames the mesh.
CameraParams camera_params(const Scene& scene, const TriangleMesh& mesh);

}  // namespace nook
