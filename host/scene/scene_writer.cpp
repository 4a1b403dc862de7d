#include "scene/scene_writer.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include "scene/effect_keys.hpp"
#include "scene/scene_keys.hpp"

namespace nook {
namespace {

// Which keys are written: all, or those that decide the samples.
using Wanted = bool (*)(const KeyInfo&);

bool every(const KeyInfo&) {
  return true;
}
bool of_samples(const KeyInfo& key) {
  return key.of_samples;
}

template <class Owner, class Reads>
std::string lines(std::span<const Key<Owner>> keys, const Owner& owner, Wanted wanted, Reads reads) {
  std::string text;
  for (const Key<Owner>& key : keys) {
    if (!wanted(key.info) || !key.in_use(owner) || !reads(key.info)) continue;
    const KeyValue value = key.field.get(owner);
    if (!std::holds_alternative<std::monostate>(value))
      text += fmt::format("{} = {}\n", key.info.name, toml_text(value));
  }
  return text;
}

std::string effect_lines(const Effect& effect, Wanted wanted) {
  return lines(effect_keys(), effect, wanted,
               [&](const KeyInfo& key) { return key.readers.contains(effect.kind); });
}

std::string write(const Scene& scene, Wanted wanted) {
  const auto read = [&](const KeyInfo& key) { return is_read(key, scene); };
  const auto all = [](const KeyInfo&) { return true; };
  std::string text = "[input]\n" + lines(input_keys(), scene, wanted, read);
  for (const Instance& instance : scene.instances)
    text += "\n[[instance]]\n" + lines(instance_keys(), instance, wanted, all);
  if (scene.ground) text += "\n[ground]\n" + lines(ground_keys(), *scene.ground, wanted, all);
  text += "\n[camera]\n" + lines(camera_keys(), scene, wanted, read);
  text += "\n[film]\n" + lines(film_keys(), scene, wanted, read);
  text += "\n[renderer]\n" + lines(renderer_keys(), scene, wanted, read);
  if (scene.effects.size() == 1 && scene.effects.front().name.empty())
    return text + effect_lines(scene.effects.front(), wanted);
  for (const Effect& effect : scene.effects) text += "\n[[effect]]\n" + effect_lines(effect, wanted);
  return text;
}

}  // namespace

std::string to_toml(const Scene& scene) {
  return write(scene, every);
}

std::string scene_hash(const Scene& scene) {
  Scene counted = scene;
  if (scene.chooses_directions()) counted.direction_choice = Scene::DirectionChoice::automatic;
  counted.stop = {};  // spp is part of it, whatever ends the render
  const std::string text = write(counted, of_samples);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace nook
