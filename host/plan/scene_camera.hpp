#pragma once

#include "kernels/shared/camera.h"
#include "math/bounds.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The camera of a scene: its own, or the automatic one, which frames `bounds`.
Camera resolve_camera(const Scene& scene, const Bounds3& bounds);

/// The camera as the kernels use it. `scene` must be validated; the automatic camera frames `bounds`.
CameraParams camera_params(const Scene& scene, const Bounds3& bounds);

}  // namespace nook
