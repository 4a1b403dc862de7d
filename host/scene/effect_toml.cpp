#include "scene/effect_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_set>

#include "scene/effect_keys.hpp"

namespace nook {
namespace {

// The course's other assignments have more types; these are the ones of its third, and what nook adds.
EffectKind read_type(TomlTable& table, bool realtime) {
  Effect effect;
  effect.kind = realtime ? EffectKind::ssao : EffectKind::ao;
  const Key<Effect>& type = effect_keys().front();
  if (const auto value = table.read(type.info)) {
    type.field.set(effect, *value);
    if (realtime && effect.kind != EffectKind::ssao)
      fail_at(table.file(), table.find("type")->source(),
              fmt::format("realtime = true renders type \"ssao\", not \"{}\"", name_of(effect.kind)));
  }
  return effect.kind;
}

// The names of EXR layers and channels that the picture itself uses.
constexpr std::string_view taken_names[] = {"R", "G", "B", "A", "N", "P", "Z", "AO"};

void check_name(TomlTable& table, const std::string& name) {
  const toml::node* node = table.find("name");
  if (!node) return;
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (name.size() > 64 || !std::all_of(name.begin(), name.end(), letter))
    table.wrong(*node, "name", "1 to 64 of the letters a-z, A-Z, 0-9, _ and -");
  if (std::find(std::begin(taken_names), std::end(taken_names), name) != std::end(taken_names))
    fail_at(table.file(), node->source(),
            fmt::format("the name '{}' is taken by a channel of the picture", name));
}

// A key of other types, which has no meaning for this one.
void refuse(TomlTable& table, const KeyInfo& key, EffectKind kind) {
  if (!table.has(key.name) || key.readers.contains(kind)) return;
  std::string types;
  for (const auto& [name, reader] : effect_names)
    if (key.readers.contains(reader)) types += fmt::format("{}{}", types.empty() ? "" : ", ", name);
  fail_at(table.file(), table.find(key.name)->source(),
          fmt::format("unknown key '{}' in {}: it is one of type {}{}{}", key.name, table.title(), types,
                      key.elsewhere.empty() ? "" : "; ", key.elsewhere));
}

Effect read_effect(TomlTable& table, bool realtime, bool (*wanted)(const KeyInfo&, EffectKind)) {
  Effect effect = default_effect(read_type(table, realtime));
  for (const Key<Effect>& key : effect_keys()) {
    if (!wanted(key.info, effect.kind))
      refuse(table, key.info, effect.kind);
    else if (const auto value = table.read(key.info))
      give(effect, key, *value);
  }
  settle(effect);
  if (const auto conflict = conflict_of(effect))
    fail_at(table.file(), table.find(conflict->key)->source(),
            fmt::format("{} {}", conflict->key, conflict->what));
  return effect;
}

}  // namespace

Effect read_only_effect(TomlTable& renderer, bool realtime) {
  return read_effect(renderer, realtime, [](const KeyInfo& key, EffectKind kind) {
    return key.name != "name" && (key.readers.contains(kind) || !key.of_type);
  });
}

Effect read_listed_effect(TomlTable& table, bool realtime) {
  if (!table.has("type")) table.missing("type");
  table.set_title(fmt::format("[[effect]] of type \"{}\"", name_of(read_type(table, realtime))));
  const Effect effect = read_effect(
      table, realtime, [](const KeyInfo& key, EffectKind kind) { return key.readers.contains(kind); });
  check_name(table, effect.name);
  table.finish();
  return effect;
}

std::vector<Effect> read_effect_list(const std::string& file, const toml::node& list, bool realtime) {
  const toml::array* tables = list.as_array();
  if (!tables || tables->empty() || !tables->is_homogeneous<toml::table>())
    fail_at(file, list.source(), "effects are tables: [[effect]]");
  std::vector<Effect> effects;
  std::unordered_set<std::string> names;
  for (const toml::node& node : *tables) {
    TomlTable table(file, "[[effect]]", node.as_table());
    effects.push_back(read_listed_effect(table, realtime));
    const std::string& name = effects.back().name;
    if (!name.empty() && !names.insert(name).second)
      fail_at(file, node.source(), fmt::format("two effects are named '{}'", name));
  }
  return effects;
}

}  // namespace nook
