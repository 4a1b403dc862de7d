// What reports and records say of an effect.
#include <fmt/format.h>

#include "scene/effect_keys.hpp"

namespace nook {

std::vector<std::pair<const KeyInfo*, KeyValue>> settings_of(const Effect& effect) {
  std::vector<std::pair<const KeyInfo*, KeyValue>> settings;
  for (const Key<Effect>& key : effect_keys())
    if (key.info.readers != all_kinds && key.info.readers.contains(effect.kind))
      settings.emplace_back(&key.info, key.field.get(effect));
  return settings;
}

std::string settings_text(const Effect& effect) {
  const Effect standard = default_effect(effect.kind);
  std::string text;
  for (const Key<Effect>& key : effect_keys()) {
    if (key.info.readers == all_kinds || !key.info.readers.contains(effect.kind)) continue;
    const KeyValue value = key.field.get(effect);
    const bool always = key.info.flag.size() > 0;  // what a command line may have changed
    if (!always && value == key.field.get(standard)) continue;
    if (std::holds_alternative<std::monostate>(value)) continue;
    const bool number = std::holds_alternative<float>(value);
    text +=
        fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", key.info.recorded_as(), plain_text(value),
                    number && !key.info.domain.unit.empty() ? " " : "", number ? key.info.domain.unit : "");
  }
  return text.empty() ? "of the surface" : text;
}

}  // namespace nook
