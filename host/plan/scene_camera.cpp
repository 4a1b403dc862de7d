#include "plan/scene_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook {
namespace {

void store(float (&out)[3], const dvec3& v) {
  for (int i = 0; i < 3; ++i) out[i] = float(v[i]);
}

// A three-quarter view from above, as near as every corner of the box stays inside 96 % of the film.
Camera framing_camera(const Scene& scene, const TriangleMesh& mesh) {
  const Bounds3& bounds = mesh.subject_bounds();
  Camera camera;
  const double half_height = 0.96 * std::tan(camera.fov * std::numbers::pi / 360);
  const double half_width = half_height * scene.width / scene.height;
  const dvec3 back = glm::normalize(dvec3(0.55, 0.4, 1.0)),
              right = glm::normalize(glm::cross(dvec3(0, 1, 0), back)), up = glm::cross(back, right);
  const dvec3 center(bounds.center());
  // At least so far that eye and center are different floats, whose difference has a direction, of a point
  // too.
  double distance = std::max(1e-30, 1e-4 * glm::length(center));
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p = dvec3(corner & 1 ? bounds.hi.x : bounds.lo.x, corner & 2 ? bounds.hi.y : bounds.lo.y,
                          corner & 4 ? bounds.hi.z : bounds.lo.z) -
                    center;
    distance = std::max({distance, glm::dot(p, back) + std::abs(glm::dot(p, right)) / half_width,
                         glm::dot(p, back) + std::abs(glm::dot(p, up)) / half_height});
  }
  camera.at = mesh.frame.to_file(dvec3(vec3(center)));
  camera.eye = mesh.frame.to_file(dvec3(vec3(center + distance * back)));
  camera.up = {0, 1, 0};
  return camera;
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
