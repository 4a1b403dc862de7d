#include "scene/scene_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "scene/effect_toml.hpp"
#include "scene/input_toml.hpp"
#include "scene/scene_keys.hpp"
#include "scene/toml_table.hpp"
#include "scene/toml_text.hpp"

namespace nook {
namespace {

// With [[effect]] tables, [renderer] keeps what they share.
void read_effects(const std::string& file, const toml::node* list, TomlTable& renderer, Scene& scene) {
  if (!list) {
    scene.effects = {read_only_effect(renderer, scene.realtime)};
    return;
  }
  if (const toml::node* type = renderer.find("type"))
    fail_at(file, type->source(), "type belongs into the [[effect]] tables of this scene");
  scene.effects = read_effect_list(file, *list, scene.realtime);
}

void read_renderer(TomlTable& renderer, Scene& scene) {
  read_keys(renderer, renderer_keys(), scene);
  check_use(renderer, renderer_keys(), scene);
  StopTarget& stop = scene.stop;
  if (!renderer.has("min_spp")) stop.min_spp = std::min(stop.min_spp, stop.max_spp);
  if (stop.min_spp > stop.max_spp)
    fail_at(renderer.file(), renderer.find("min_spp")->source(),
            fmt::format("min_spp is above max_spp, {}", stop.max_spp));
}

toml::table parsed(const std::string& text, const std::filesystem::path& path) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& e) {
    if (e.source().begin.line == 0) throw Error(ErrorKind::scene, Place{path.string()}, e.description());
    fail_at(path.string(), e.source(), std::string(e.description()));
  }
}

Scene scene_of(const toml::table& root, const std::filesystem::path& path) {
  const std::string file = path.string();
  TomlTable top(file, "the scene", &root);
  auto table = [&](const char* key) {
    const toml::node* node = top.find(key);
    if (node && !node->is_table())
      fail_at(file, node->source(), fmt::format("{} must be a table: [{}]", key, key));
    return TomlTable(file, fmt::format("[{}]", key), node ? node->as_table() : nullptr);
  };
  TomlTable input = table("input"), camera = table("camera"), film = table("film"),
            renderer = table("renderer"), ground = table("ground");

  Scene scene;
  scene.file = path;
  read_input(input, ground, top.find("instance"), scene);
  read_keys(camera, camera_keys(), scene);
  const toml::node* frame = camera.find("frame");
  if (frame && camera.has("view") && frame->as_boolean() && !**frame->as_boolean())
    fail_at(file, frame->source(), "view frames the mesh: frame = false goes with eye and at");
  check_use(camera, camera_keys(), scene);
  read_keys(film, film_keys(), scene);
  read_renderer(renderer, scene);
  read_effects(file, top.find("effect"), renderer, scene);
  for (const TomlTable* each : {&top, &input, &camera, &film, &renderer, &ground}) each->finish();
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path) {
  return scene_of(parsed(read_toml_text(path), path), path);
}

Scene parse_scene(const std::string& text, const std::filesystem::path& file) {
  check_toml_text(text, file);
  return scene_of(parsed(text, file), file);
}

Scene scene_of_mesh(const std::filesystem::path& mesh_file) {
  Scene scene;
  scene.file = mesh_file;
  scene.mesh_file = mesh_file;
  scene.automatic_camera = true;
  scene.effects = {Effect{}};
  scene.spp = 16;
  return scene;
}

Scene picture_of_mesh(const std::filesystem::path& mesh_file) {
  Scene scene = scene_of_mesh(mesh_file);
  scene.ground.emplace();
  scene.background = {.transparent = true};
  scene.effects.front().side = Side::viewer;  // whatever the winding is
  scene.effects.front().max_distance = {DistanceLimit::Kind::none, 0};
  return scene;
}

void validate(const Scene& scene) {
  const std::string file = scene.file.string();
  const dvec3 view = dvec3(scene.camera.at) - dvec3(scene.camera.eye), up(scene.camera.up);
  if (glm::length(up) == 0) throw Error(ErrorKind::scene, Place{file}, "the camera's up is zero");
  if (!scene.automatic_camera) {
    if (glm::length(view) == 0)
      throw Error(ErrorKind::scene, Place{file}, "the camera's eye and at are the same point");
    if (glm::length(glm::cross(glm::normalize(view), glm::normalize(up))) < 1e-6)
      throw Error(ErrorKind::scene, Place{file}, "the camera's up is parallel to its view direction");
  }
  if (scene.crop) {
    const PixelRect& c = *scene.crop;
    if (c.x0 < 0 || c.y0 < 0 || c.x0 >= c.x1 || c.y0 >= c.y1 || c.x1 > scene.width || c.y1 > scene.height)
      throw Error(ErrorKind::scene, Place{file},
                  fmt::format("the crop {},{},{},{} (x0,x1,y0,y1) is empty or outside the {}x{} film", c.x0,
                              c.x1, c.y0, c.y1, scene.width, scene.height));
  }
}

}  // namespace nook
