#include "app/commands/turntable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace nook {

Camera turned_camera(const Camera& camera, unsigned index, unsigned count) {
  if (index == 0) return camera;
  // Rodrigues' formula, in double precision: every picture from the first, so that no error adds up.
  const double angle = 2 * glm::pi<double>() * index / count;
  const dvec3 axis = glm::normalize(dvec3(camera.up)), at = camera.at, arm = camera.eye - at;
  const dvec3 along = glm::dot(arm, axis) * axis, across = arm - along;
  Camera turned = camera;
  turned.eye = at + along + std::cos(angle) * across + std::sin(angle) * glm::cross(axis, across);
  return turned;
}

std::filesystem::path numbered_file(const std::filesystem::path& file, unsigned index, unsigned count) {
  if (file.empty()) return file;
  const int digits = std::max(4, int(std::to_string(count - 1).size()));
  return file.parent_path() /
         fmt::format("{}_{:0{}}{}", file.stem().string(), index, digits, file.extension().string());
}

}  // namespace nook
