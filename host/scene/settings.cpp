#include "scene/settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "scene/effect_keys.hpp"
#include "scene/effect_toml.hpp"
#include "scene/scene_keys.hpp"
#include "scene/toml_table.hpp"
#include "scene/toml_text.hpp"

namespace nook {
namespace {

const std::string no_file;

[[noreturn]] void refuse(std::string_view key, const std::string& why) {
  throw Error(ErrorKind::usage, fmt::format("{}: {}", key, why));
}

// Which effects there are, before what is set of them.
void choose_effects(TomlTable& given, Scene& scene) {
  const KeyInfo &type = effect_keys().front().info, &realtime = renderer_keys().front().info;
  const auto drawn = given.read(realtime);
  if (drawn) scene.realtime = std::get<bool>(*drawn);
  const toml::node* list = given.find("effect");
  const auto kind = given.read(type);
  if (list && kind) refuse("type", "belongs into the list of effects");
  if (list) {
    scene.effects = read_effect_list(no_file, *list, scene.realtime);
  } else if (kind) {
    scene.effects = {default_effect(*value_of<EffectKind>(effect_names, std::get<std::string>(*kind)))};
    if (scene.realtime && !is_ssao_alone(scene))
      refuse("type", "realtime = true renders type \"ssao\" alone");
  } else if (drawn && scene.realtime && !is_ssao_alone(scene)) {
    scene.effects = {default_effect(EffectKind::ssao)};
  }
}

void set_of_effects(TomlTable& given, Scene& scene) {
  for (const Key<Effect>& key : effect_keys().subspan(1)) {
    if (key.info.name == "name") continue;
    const auto value = given.read(key.info);
    if (!value) continue;
    if (!is_read(key.info, scene))
      refuse(key.info.name, fmt::format("the scene has no effect {}", readers_text(key.info)));
    for (Effect& effect : scene.effects)
      if (key.info.readers.contains(effect.kind)) give(effect, key, *value);
  }
  for (Effect& effect : scene.effects) {
    settle(effect);
    if (const auto conflict = conflict_of(effect)) refuse(conflict->key, conflict->what);
  }
}

void set_of_renderer(TomlTable& given, Scene& scene) {
  const bool targets = given.has("error") || given.has("time");
  if (given.has("spp") && !targets) scene.stop = {};
  read_keys(given, renderer_keys(), scene);
  check_use(given, renderer_keys(), scene);
  for (const Key<Scene>& key : renderer_keys())
    if (given.has(key.info.name) && !is_read(key.info, scene))
      refuse(key.info.name, fmt::format("the scene has no effect {}", readers_text(key.info)));
  StopTarget& stop = scene.stop;
  if (given.has("min_spp") && stop.min_spp > stop.max_spp)
    refuse("min_spp", fmt::format("is above max_spp, {}", stop.max_spp));
  stop.min_spp = std::min(stop.min_spp, stop.max_spp);
}

void set_of_mesh(TomlTable& given, Scene& scene) {
  for (const Key<Scene>& key : input_keys())
    if (key.info.name != "objfile")
      if (const auto value = given.read(key.info)) key.field.set(scene, *value);
  if (scene.instances.empty() && scene.instancing != Instancing::automatic)
    refuse("instancing", "needs a scene file with [[instance]] or a list of meshes");
  const toml::node* ground = given.find("ground");
  if (!ground) return;
  if (!ground->is_table()) refuse("ground", "must be a table of height and reach, which may be empty");
  TomlTable table(no_file, "ground", ground->as_table());
  scene.ground.emplace();
  read_keys(table, ground_keys(), *scene.ground);
  table.finish();
  if (scene.ground->none) scene.ground.reset();
}

}  // namespace

void apply_settings(const std::string& lines, bool of_mesh, Scene& scene) try {
  check_toml_text(lines, no_file);
  const toml::table root = toml::parse(lines);
  TomlTable given(no_file, "a scene", &root);
  choose_effects(given, scene);
  // A camera's place is given to who wants that instead of a view that frames the mesh.
  if (!given.has("frame") && (given.has("eye") || given.has("at"))) scene.automatic_camera = false;
  const toml::node* frame = given.find("frame");
  if (frame && given.has("view") && frame->as_boolean() && !**frame->as_boolean())
    refuse("view", "frames the mesh: frame = false goes with eye and at");
  read_keys(given, camera_keys(), scene);
  check_use(given, camera_keys(), scene);
  read_keys(given, film_keys(), scene);
  set_of_renderer(given, scene);
  set_of_effects(given, scene);
  if (of_mesh) set_of_mesh(given, scene);
  given.finish();
} catch (const Error& e) {
  throw Error(ErrorKind::usage, e.what());
} catch (const toml::parse_error& e) {
  throw Error(ErrorKind::usage, std::string(e.description()));
}

}  // namespace nook
