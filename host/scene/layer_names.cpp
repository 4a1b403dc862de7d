#include "scene/layer_names.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "scene/names.hpp"

namespace nook {

std::size_t main_effect(const Scene& scene) {
  const auto found = std::find_if(scene.effects.begin(), scene.effects.end(),
                                  [](const Effect& e) { return e.kind != EffectKind::ssao; });
  return found == scene.effects.end() ? 0 : std::size_t(found - scene.effects.begin());
}

std::vector<std::string> layer_prefixes(const Scene& scene) {
  const std::size_t main = main_effect(scene);
  std::unordered_set<std::string> taken;
  for (const Effect& effect : scene.effects) taken.insert(effect.name);
  std::unordered_map<EffectKind, int> last_number;
  std::vector<std::string> prefixes;
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const Effect& effect = scene.effects[e];
    std::string name = effect.name;
    if (name.empty() && e == main && effect.kind != EffectKind::bent) {
      prefixes.emplace_back();
      continue;
    }
    const std::string type(name_of(effect.kind));
    for (int& number = last_number[effect.kind]; name.empty();) {
      ++number;
      const std::string numbered = number == 1 ? type : type + std::to_string(number);
      if (taken.insert(numbered).second) name = numbered;
    }
    prefixes.push_back(name + ".");
  }
  return prefixes;
}

std::string effect_label(EffectKind kind, const std::string& layer_prefix) {
  return layer_prefix.empty() ? std::string(name_of(kind)) : layer_prefix.substr(0, layer_prefix.size() - 1);
}

}  // namespace nook
