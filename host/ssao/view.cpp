#include "ssao/view.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.hpp"

namespace nook {

vec3 SsaoView::to_view(const vec3& world) const {
  const vec3 p = world - eye;
  return {glm::dot(right, p), glm::dot(up, p), glm::dot(backward, p)};
}

vec3 SsaoView::direction_to_world(const vec3& view) const {
  return view.x * right + view.y * up + view.z * backward;
}

vec3 SsaoView::to_world(const vec3& view) const {
  return eye + direction_to_world(view);
}

vec2 SsaoView::project(const vec3& view) const {
  return (vec2(view) / -view.z - ray_offset) / ray_scale;
}

vec3 SsaoView::reconstruct(const vec2& buffer, float depth) const {
  return depth * vec3(buffer * ray_scale + ray_offset, -1.0f);
}

SsaoView make_ssao_view(const Camera& camera, int width, int height, int guard) {
  const dvec3 forward = camera.at - camera.eye;
  const dvec3 right = glm::cross(forward, dvec3(camera.up));
  if (!(glm::dot(forward, forward) > 0))
    throw Error(ErrorKind::scene, "the camera's eye and at are the same point");
  if (!(glm::length(right) > 1e-7 * glm::length(forward) * glm::length(dvec3(camera.up))))
    throw Error(ErrorKind::scene, "the camera's up is along its line of sight");
  SsaoView view;
  const dvec3 unit_forward = glm::normalize(forward), unit_right = glm::normalize(right);
  view.eye = vec3(camera.eye);
  view.right = vec3(unit_right);
  view.up = vec3(glm::cross(unit_right, unit_forward));
  view.backward = vec3(-unit_forward);
  view.width = width;
  view.height = height;
  view.guard = guard;
  const double tan_y = std::tan(glm::pi<double>() / 360.0 * camera.fov), tan_x = tan_y * width / height;
  view.ray_scale = vec2(2.0 * tan_x / width, -2.0 * tan_y / height);
  view.ray_offset = vec2(-tan_x * (1.0 + 2.0 * guard / width), tan_y * (1.0 + 2.0 * guard / height));
  return view;
}

}  // namespace nook
