#include "plan/scene_ground.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/instance.hpp"
#include "plan/framing.hpp"
#include "plan/scene_camera.hpp"

namespace nook {
namespace {

// In bounding radii.
constexpr float least_reach = 20, most_reach = 1000;
// A mesh that is lower than this part of its radius lies on the ground, which would fight with it for rays.
constexpr double flat = 1e-4;

Axis up_of(const Scene& scene) {
  if (scene.ground->up) return *scene.ground->up;
  return scene.automatic_camera ? nearest_axis(scene.camera.up) : Axis::y;
}

// As far as the picture shows it, and again, from the mesh's center: the corners' rays go farthest.
float reach_in_picture(const CameraParams& camera, const TriangleMesh& mesh, Axis up, float height) {
  const float radius = mesh.bounds.bounding_radius();
  const dvec3 upwards = direction_of(up), center(mesh.bounds.center()),
              eye(camera.eye[0], camera.eye[1], camera.eye[2]);
  const double above = (eye[number_of(up)] - height) * upwards[number_of(up)];
  double reach = 0;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      dvec3 ray;
      for (int i = 0; i < 3; ++i)
        ray[i] = camera.forward[i] + x * camera.tan_half_fov_x * camera.right[i] +
                 y * camera.tan_half_fov_y * camera.up[i];
      const double falls = -glm::dot(ray, upwards);
      if (!(falls > 0)) return most_reach * radius;
      const dvec3 seen = eye + above / falls * ray - center;
      reach = std::max(reach, glm::length(seen - glm::dot(seen, upwards) * upwards));
    }
  return float(std::clamp(2 * reach, double(least_reach * radius), double(most_reach * radius)));
}

}  // namespace

void add_ground(const Scene& scene, TriangleMesh& mesh) {
  const Frame& frame = mesh.frame;
  const Axis up = up_of(scene);
  const int axis = number_of(up);
  const Bounds3& b = mesh.bounds;
  const bool given = scene.ground->height.has_value();
  const float height = given             ? float(frame.from_file(*scene.ground->height - frame.center[axis]))
                       : is_opposite(up) ? b.hi[axis]
                                         : b.lo[axis];
  float reach = scene.ground->reach ? float(frame.from_file(double(*scene.ground->reach)))
                                    : least_reach * b.bounding_radius();
  if (scene.automatic_camera) {
    const CameraParams camera = camera_params(scene, mesh);
    const double above = (camera.eye[axis] - double(height)) * direction_of(up)[axis];
    if (!given && !(above > 0)) mesh.why_no_ground = "the camera is not above it";
    if (!given && b.hi[axis] - b.lo[axis] <= flat * b.bounding_radius())
      mesh.why_no_ground = "the mesh lies flat on it";
    if (!mesh.why_no_ground.empty()) return;
    if (!scene.ground->reach && above > 0) reach = reach_in_picture(camera, mesh, up, height);
  }
  append_ground(mesh, height, reach, up);
}

std::optional<Ground> settled_ground(const TriangleMesh& mesh) {
  if (mesh.subject.empty()) return std::nullopt;
  Ground ground;
  ground.up = mesh.ground.up;
  ground.height = mesh.frame.to_file(dvec3(mesh.ground.height))[number_of(mesh.ground.up)];
  ground.reach = float(mesh.frame.to_file(double(mesh.ground.reach)));
  return ground;
}

}  // namespace nook
