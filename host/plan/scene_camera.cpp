#include "plan/scene_camera.hpp"

#include <cmath>
#include <numbers>

#include "plan/framing.hpp"

namespace nook {
namespace {

void store(float (&out)[3], const dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = float(v[i]);
}

}  // namespace

Camera resolve_camera(const Scene& scene, const TriangleMesh& mesh) {
  return scene.automatic_camera ? framing_camera(scene, mesh) : scene.camera;
}

Camera in_frame(Camera camera, const Frame& frame) {
  camera.eye = frame.from_file(camera.eye);
  camera.at = frame.from_file(camera.at);
  return camera;
}

CameraParams camera_params(const Scene& scene, const TriangleMesh& mesh) {
  const Camera camera = in_frame(resolve_camera(scene, mesh), mesh.frame);
  const dvec3 forward = glm::normalize(camera.at - camera.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
  const double tangent = std::tan(camera.fov * std::numbers::pi / 360);
  CameraParams params{};
  store(params.eye, camera.eye);
  store(params.right, right);
  store(params.up, glm::cross(right, forward));
  store(params.forward, forward);
  params.width = nook_uint(scene.width);
  params.height = nook_uint(scene.height);
  params.tan_half_fov_y = float(tangent);
  params.tan_half_fov_x = float(tangent * scene.width / scene.height);
  return params;
}

}  // namespace nook
