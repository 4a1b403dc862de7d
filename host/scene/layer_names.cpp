#include "scene/layer_names.hpp"

#include <algorithm>

#include "scene/names.hpp"

namespace nook {

std::size_t main_effect(const Scene& scene) {
  const auto found = std::find_if(scene.effects.begin(), scene.effects.end(),
                                  [](const Effect& e) { return e.kind != EffectKind::ssao; });
  return found == scene.effects.end() ? 0 : std::size_t(found - scene.effects.begin());
}

std::vector<std::string> layer_prefixes(const Scene& scene) {
  const std::size_t main = main_effect(scene);
  std::vector<std::string> prefixes;
  const auto taken = [&](const std::string& name) {
    return std::any_of(scene.effects.begin(), scene.effects.end(),
                       [&](const Effect& e) { return e.name == name; }) ||
           std::find(prefixes.begin(), prefixes.end(), name + ".") != prefixes.end();
  };
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const Effect& effect = scene.effects[e];
    std::string name = effect.name;
    if (name.empty() && e == main && effect.kind != EffectKind::bent) {
      prefixes.emplace_back();
      continue;
    }
    if (name.empty()) {
      const std::string type(name_of(effect.kind));
      name = type;
      for (int number = 2; taken(name); ++number) name = type + std::to_string(number);
    }
    prefixes.push_back(name + ".");
  }
  return prefixes;
}

std::string effect_label(EffectKind kind, const std::string& layer_prefix) {
  return layer_prefix.empty() ? std::string(name_of(kind)) : layer_prefix.substr(0, layer_prefix.size() - 1);
}

}  // namespace nook
