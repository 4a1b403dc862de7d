#include "render/repeat.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "scene/scene_writer.hpp"

namespace nook {

std::map<std::string, std::string> Repeat::attributes() const {
  std::map<std::string, std::string> made = {{"nook/scene", scene}, {"nook/mesh_hash", mesh_hash}};
  if (!aovs.empty()) made["nook/aovs"] = fmt::format("{}", fmt::join(aovs, ","));
  if (!why_not.empty()) made["nook/not_repeatable"] = why_not;
  return made;
}

std::string scene_attribute(const Scene& scene) {
  Scene absolute = scene;
  const auto place = [](std::filesystem::path& mesh) {
    if (!mesh.empty()) mesh = std::filesystem::absolute(mesh).lexically_normal();
  };
  place(absolute.mesh_file);
  for (Instance& instance : absolute.instances) place(instance.mesh_file);
  return to_toml(absolute);
}

}  // namespace nook
