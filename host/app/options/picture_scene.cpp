#include "app/options/picture_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "image/exr.hpp"
#include "scene/scene_toml.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

using Attributes = std::map<std::string, std::string>;

std::string text_of(const Attributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

// Every file of a mesh that the scene names.
template <class Use>
void for_each_mesh(Scene& scene, Use use) {
  if (!scene.mesh_file.empty()) use(scene.mesh_file);
  for (Instance& instance : scene.instances) use(instance.mesh_file);
}

// Picture and meshes may have moved together: then a mesh lies from the picture as it did.
void find_meshes(Scene& scene, const fs::path& folder_then, const fs::path& picture) {
  for_each_mesh(scene, [&](fs::path& mesh) {
    std::error_code code;
    if (fs::exists(mesh, code) || folder_then.empty()) return;
    const fs::path moved =
        (fs::absolute(picture).parent_path() / mesh.lexically_relative(folder_then)).lexically_normal();
    if (fs::exists(moved, code)) mesh = moved;
  });
}

Scene scene_of(const Attributes& attributes, const fs::path& file) {
  const std::string text = text_of(attributes, "nook/scene");
  if (text.empty())
    throw Error(ErrorKind::scene, Place{file.string()},
                "has no scene in its attributes (nook/scene): nook render writes one");
  Scene scene = parse_scene(text, file);
  find_meshes(scene, text_of(attributes, "nook/folder"), file);
  return scene;
}

}  // namespace

bool is_picture(const fs::path& file) {
  return file.extension() == ".exr" || file.extension() == ".EXR";
}

Scene scene_of_picture(const fs::path& file) {
  return scene_of(read_exr_attributes(file), file);
}

PictureOrigin origin_of_picture(const fs::path& file) {
  const Attributes attributes = read_exr_attributes(file);
  PictureOrigin origin;
  origin.scene = scene_of(attributes, file);
  origin.mesh_hash = text_of(attributes, "nook/mesh_hash");
  origin.why_not = text_of(attributes, "nook/not_repeatable");
  std::istringstream aovs(text_of(attributes, "nook/aovs"));
  for (std::string name; std::getline(aovs, name, ',');) origin.aovs.push_back(name);
  if (!origin.scene.stop.seconds || origin.scene.stop.error || !origin.why_not.empty()) return origin;
  const Image image = read_exr(file);
  const Channel* channel = image.find(camera_rays_channel);
  const auto* rays = channel ? std::get_if<std::vector<std::uint32_t>>(&channel->values) : nullptr;
  const Scene& scene = origin.scene;
  const PixelRect window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  const auto pixels = std::size_t(window.width()) * std::size_t(window.height());
  if (!rays || rays->size() != pixels)
    origin.why_not = "its channel camera_rays, what each pixel got, is missing";
  else if (*std::max_element(rays->begin(), rays->end()) > std::max(2u, scene.stop.max_spp))
    origin.why_not = "its channel camera_rays has more than max_spp";
  else
    origin.camera_rays = *rays;
  return origin;
}

void check_mesh(const Scene& scene, const std::string& made_of, const std::string& hash) {
  if (!made_of.empty() && made_of != hash)
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                fmt::format("cannot be made again: {} is not the mesh that it was made of ({}, now {})",
                            scene.mesh_file.string(), made_of, hash));
}

}  // namespace nook
