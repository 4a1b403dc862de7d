#include "app/options/scene_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "app/options/key_flags.hpp"
#include "app/options/picture_scene.hpp"
#include "base/error.hpp"
#include "base/threads.hpp"
#include "device/prepare.hpp"
#include "mesh/load_mesh.hpp"
#include "plan/plan.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "scene/scene_toml.hpp"

namespace nook {
namespace {

// "800x600"
std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, width);
  const auto [stop, second] = x < end && *x == 'x' ? std::from_chars(x + 1, end, height)
                                                   : std::from_chars_result{x, std::errc::invalid_argument};
  if (first != std::errc() || second != std::errc() || stop != end || width < 1 || height < 1 ||
      width > 65535 || height > 65535)
    throw Error(ErrorKind::usage,
                fmt::format("--size: '{}' is not WIDTHxHEIGHT with 1 to 65535 pixels each", text));
  return {width, height};
}

// The flags of every command that loads a scene: what decides the samples. How long to take them, and what is
// made of them, are `nook render`'s.
template <class Use>
void for_each_flag(Use use) {
  const auto each = [&](const auto& keys) {
    for (const auto& key : keys)
      if (!key.info.flag.empty() && key.info.of_samples) use(key.info);
  };
  each(camera_keys());
  each(ground_keys());
  each(renderer_keys());
  each(effect_keys());
}

}  // namespace

void SceneOptions::add_to(CLI::App& command, EffectKinds kinds, const std::set<std::string_view>& left_out) {
  of_pictures = !left_out.contains("--view");
  command
      .add_option("scene", scene,
                  "Scene file (TOML), a bare mesh (.obj, .ply, .stl, each also .gz), or an .exr picture: the "
                  "scene that made it")
      ->required();
  for_each_flag([&](const KeyInfo& key) {
    if (key.readers.intersects(kinds) && !left_out.contains(key.flag))
      add_key_flag(command, key, texts[std::string(key.flag)]);
  });
  if (!left_out.contains("--size"))
    command.add_option("--size", size, "Image size, e.g. 800x600")->envname("NOOK_SIZE");
  if (left_out.contains("--crop")) return;
  command.add_option("--crop", crop, "Render pixels x0 <= x < x1, y0 <= y < y1 only: x0,x1,y0,y1")
      ->delimiter(',')
      ->expected(4)
      ->envname("NOOK_CROP");
}

void SceneOptions::add_background_to(CLI::App& command) {
  add_key_flag(command, *key_of_flag("--background"), texts["--background"]);
}

template <class Owner>
void SceneOptions::apply(std::span<const Key<Owner>> keys, Owner& owner) const {
  for (const Key<Owner>& key : keys)
    if (has(std::string(key.info.flag)))
      key.field.set(owner, *parse_value(texts.at(std::string(key.info.flag)), key.info.domain));
}

bool SceneOptions::has(const std::string& flag) const {
  const auto found = texts.find(flag);
  return found != texts.end() && !found->second.empty();
}

std::vector<const KeyInfo*> SceneOptions::given() const {
  std::vector<const KeyInfo*> keys;
  for_each_flag([&](const KeyInfo& key) {
    if (has(std::string(key.flag))) keys.push_back(&key);
  });
  return keys;
}

void SceneOptions::apply(Effect& effect) const {
  for (const Key<Effect>& key : effect_keys())
    if (key.info.readers.contains(effect.kind) && has(std::string(key.info.flag)))
      give(effect, key, *parse_value(texts.at(std::string(key.info.flag)), key.info.domain));
  settle(effect);
  if (const auto conflict = conflict_of(effect)) {
    const auto keys = given();
    const auto flag = std::find_if(keys.begin(), keys.end(),
                                   [&](const KeyInfo* key) { return key->name == conflict->key; });
    throw Error(ErrorKind::usage,
                fmt::format("{}: {}", flag == keys.end() ? conflict->key : (*flag)->flag, conflict->what));
  }
}

Scene SceneOptions::load(const std::function<void(Scene&)>& choose) const {
  if (is_unread_mesh(scene)) refuse_format(scene);
  Scene loaded = is_picture(scene) ? scene_of_picture(scene)
                 : is_mesh(scene)  ? (of_pictures ? picture_of_mesh(scene) : scene_of_mesh(scene))
                                   : load_scene(scene);
  if (choose) choose(loaded);
  for (const auto keys : {camera_keys(), film_keys(), renderer_keys()}) apply(keys, loaded);
  if (has("--ground")) {
    if (!loaded.ground) loaded.ground.emplace();
    apply(ground_keys(), *loaded.ground);
    if (loaded.ground->none) loaded.ground.reset();
  }
  for (Effect& effect : loaded.effects) apply(effect);
  if (size) std::tie(loaded.width, loaded.height) = parse_size(*size);
  if (!crop.empty()) loaded.crop = PixelRect{crop[0], crop[2], crop[1], crop[3]};
  validate(loaded);
  check_samples(loaded, loaded.spp);
  return loaded;
}

void SceneOptions::check_applicable(const Scene& loaded) const {
  for (const KeyInfo* key : given())
    if (!is_read(*key, loaded) && !std::getenv(key->variable().c_str()))
      throw Error(ErrorKind::usage, fmt::format("{}: {} has no effect {}", key->flag, loaded.file.string(),
                                                readers_text(*key)));
}

void keep_inputs(const Scene& scene, const std::filesystem::path& output) {
  const auto refuse = [&](const std::filesystem::path& input) {
    std::error_code code;
    if (std::filesystem::equivalent(input, output, code))
      throw Error(ErrorKind::output, Place{output.string()},
                  "is the scene's own file, it would be overwritten");
  };
  refuse(scene.file);
  refuse(scene.mesh_file);
  for (const Instance& instance : scene.instances) refuse(instance.mesh_file);
}

void DeviceOptions::add_to(CLI::App& command) {
  command
      .add_option("--device", selector, "cpu, gpu, PLATFORM:DEVICE, or a part of a name (see nook devices)")
      ->envname("NOOK_DEVICE");
  command
      .add_option("--threads", threads,
                  "Threads to use, of a CPU device and of nook itself; 0: one for each processor it may use")
      ->envname("NOOK_THREADS");
}

void DeviceOptions::prepare(bool opencl) const {
  if (opencl)
    prepare_for_opencl(threads);
  else
    limit_own_threads(threads);
}

Device DeviceOptions::open() const {
  prepare();
  return Device(select_device(selector));
}

}  // namespace nook
