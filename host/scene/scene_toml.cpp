#include "scene/scene_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "scene/effect_toml.hpp"
#include "scene/input_toml.hpp"
#include "scene/toml_table.hpp"

namespace nook {
namespace {

// With [[effect]] tables, [renderer] keeps what they share.
void read_effects(const std::string& file, const toml::node* list, TomlTable& renderer, Scene& scene) {
  if (!list) {
    scene.effects = {read_only_effect(renderer, scene.realtime)};
    return;
  }
  const toml::array* tables = list->as_array();
  if (!tables || tables->empty() || !tables->is_homogeneous<toml::table>())
    fail_at(file, list->source(), "effects are tables: [[effect]]");
  if (const toml::node* type = renderer.find("type"))
    fail_at(file, type->source(), "type belongs into the [[effect]] tables of this scene");
  for (const toml::node& node : *tables) {
    TomlTable table(file, "[[effect]]", node.as_table());
    const Effect effect = read_listed_effect(table, scene.realtime);
    for (const Effect& other : scene.effects)
      if (!effect.name.empty() && effect.name == other.name)
        fail_at(file, node.source(), fmt::format("two effects are named '{}'", effect.name));
    scene.effects.push_back(effect);
  }
}

// error, time and what goes with them, instead of spp.
void read_stop(TomlTable& renderer, Scene& scene) {
  StopTarget& stop = scene.stop;
  const bool error = renderer.has("error"), seconds = renderer.has("time");
  if (error) stop.error = renderer.number("error", 0, 1e-4, 1, "a standard error from 1e-4 to 1");
  if (seconds) stop.seconds = renderer.number("time", 0, 0.05, 1e7, "seconds from 0.05 to 1e7");
  const auto needs = [&](const char* key, bool fulfilled, const char* what) {
    if (renderer.has(key) && !fulfilled)
      fail_at(renderer.file(), renderer.find(key)->source(), fmt::format("{} goes with {}", key, what));
  };
  needs("confidence", error, "error");
  needs("min_spp", error, "error");
  needs("max_spp", error || seconds, "error or time");
  if (stop.any() && renderer.has("spp"))
    fail_at(renderer.file(), renderer.find("spp")->source(),
            "spp and error or time exclude one another; max_spp bounds them");
  stop.confidence = renderer.number("confidence", stop.confidence, 0.5, 0.9999, "from 0.5 to 0.9999");
  stop.max_spp = std::uint32_t(renderer.integer("max_spp", stop.max_spp, 1, 1 << 26));
  stop.min_spp = std::uint32_t(renderer.integer("min_spp", std::min(stop.min_spp, stop.max_spp), 1, 1 << 26));
  if (stop.min_spp > stop.max_spp)
    fail_at(renderer.file(), renderer.find("min_spp")->source(),
            fmt::format("min_spp is above max_spp, {}", stop.max_spp));
}

void read_renderer(TomlTable& renderer, Scene& scene) {
  scene.realtime = renderer.boolean("realtime", false);
  scene.spp = std::uint32_t(renderer.integer("spp", 1, 1, 1 << 26));
  scene.directions = std::uint32_t(renderer.integer("directions", 1, 1, 1 << 26));
  scene.sampler = renderer.choice<Sampler>("sampler", Sampler::sobol, sampler_names);
  read_stop(renderer, scene);
  scene.seed = std::uint32_t(renderer.integer("seed", 0, 0, 0xffffffffLL));
  static constexpr std::pair<std::string_view, bool> compat_names[] = {{"tinyrender", true}, {"none", false}};
  scene.denoise = renderer.boolean("denoise", false);
  scene.compat_tinyrender = renderer.choice<bool>("compat", false, compat_names);
}

void read_film(TomlTable& film, Scene& scene) {
  scene.width = int(film.integer("width", scene.width, 1, 65535));
  scene.height = int(film.integer("height", scene.height, 1, 65535));
  const toml::node* node = film.find("crop");
  if (!node) return;
  const toml::array* array = node->as_array();
  std::array<int, 4> edges{};
  bool valid = array && array->size() == 4;
  for (std::size_t i = 0; valid && i < 4; ++i) {
    const auto* edge = array->get(i)->as_integer();
    valid = edge && **edge >= 0 && **edge <= 65535;
    if (valid) edges[i] = int(**edge);
  }
  if (!valid) film.wrong(*node, "crop", "four integers x0, x1, y0, y1");
  scene.crop = PixelRect{edges[0], edges[2], edges[1], edges[3]};
}

toml::table parse(const std::filesystem::path& path) {
  constexpr std::uint64_t largest = 16u << 20;
  if (size_of_input(path) > largest)
    throw Error(ExitCode::scene, fmt::format("{}: too large for a scene file (over 16 MiB)", path.string()));
  try {
    return toml::parse_file(path.string());
  } catch (const toml::parse_error& e) {
    if (e.source().begin.line == 0)
      throw Error(ExitCode::scene, fmt::format("{}: {}", path.string(), e.description()));
    fail_at(path.string(), e.source(), std::string(e.description()));
  }
}

}  // namespace

Scene load_scene(const std::filesystem::path& path) {
  const toml::table root = parse(path);
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
  scene.camera.fov =
      float(camera.number("fov", scene.camera.fov, 0, 180, "an angle above 0 and below 180 degrees", true));
  scene.camera.eye = camera.point("eye", scene.camera.eye);
  scene.camera.at = camera.point("at", scene.camera.at);
  scene.camera.up = camera.point("up", scene.camera.up);
  read_film(film, scene);
  read_renderer(renderer, scene);
  read_effects(file, top.find("effect"), renderer, scene);
  for (const TomlTable* each : {&top, &input, &camera, &film, &renderer, &ground}) each->finish();
  return scene;
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

void validate(const Scene& scene) {
  const std::string file = scene.file.string();
  const dvec3 view = dvec3(scene.camera.at) - dvec3(scene.camera.eye), up(scene.camera.up);
  if (!scene.automatic_camera) {
    if (glm::length(view) == 0)
      throw Error(ExitCode::scene, fmt::format("{}: the camera's eye and at are the same point", file));
    if (glm::length(up) == 0) throw Error(ExitCode::scene, fmt::format("{}: the camera's up is zero", file));
    if (glm::length(glm::cross(glm::normalize(view), glm::normalize(up))) < 1e-6)
      throw Error(ExitCode::scene,
                  fmt::format("{}: the camera's up is parallel to its view direction", file));
  }
  if (scene.crop) {
    const PixelRect& c = *scene.crop;
    if (c.x0 < 0 || c.y0 < 0 || c.x0 >= c.x1 || c.y0 >= c.y1 || c.x1 > scene.width || c.y1 > scene.height)
      throw Error(ExitCode::scene,
                  fmt::format("{}: the crop {},{},{},{} (x0,x1,y0,y1) is empty or outside the {}x{} film",
                              file, c.x0, c.x1, c.y0, c.y1, scene.width, scene.height));
  }
}

}  // namespace nook
