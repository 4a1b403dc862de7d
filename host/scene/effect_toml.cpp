#include "scene/effect_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scene/names.hpp"

namespace nook {
namespace {

// The course's other assignments have more types; these are the ones of its third, and what nook adds.
EffectKind read_type(TomlTable& table, bool realtime) {
  const toml::node* node = table.find("type");
  const EffectKind kind =
      table.choice<EffectKind>("type", realtime ? EffectKind::ssao : EffectKind::ao, effect_names);
  if (node && realtime && kind != EffectKind::ssao)
    fail_at(table.file(), node->source(),
            fmt::format("realtime = true renders type \"ssao\", not \"{}\"", name_of(kind)));
  return kind;
}

Sampling read_sampling(TomlTable& table, EffectKind kind) {
  const toml::node* node = table.find("sampling_type");
  const Sampling fallback = kind == EffectKind::ro ? Sampling::lobe : Sampling::cosine;
  const Sampling sampling = table.choice<Sampling>("sampling_type", fallback, sampling_names);
  if (node && kind != EffectKind::ro && (sampling == Sampling::lobe || sampling == Sampling::mixture))
    fail_at(table.file(), node->source(),
            fmt::format("sampling_type \"{}\" needs type \"ro\"", name_of(sampling)));
  return sampling;
}

SsaoSettings read_ssao(TomlTable& table) {
  SsaoSettings ssao;
  ssao.method = table.choice<SsaoSettings::Method>("method", ssao.method, ssao_method_names);
  if (table.has("quality"))
    ssao.quality =
        table.choice<SsaoSettings::Quality>("quality", SsaoSettings::Quality::real_time, ssao_quality_names);
  else
    table.find("quality");
  if (const toml::node* node = table.find("radius");
      node && node->is_string() && node->value_or("") == std::string("auto"))
    ssao.radius = 0;
  else
    ssao.radius = float(table.number("radius", ssao.radius, 0, 1e30, "a radius above 0, or \"auto\"", true));
  ssao.bias = float(table.number("bias", ssao.bias, 0, 1e30, "a distance of at least 0"));
  ssao.samples = int(table.integer("samples", ssao.samples, 1, 32));
  ssao.range_check = table.boolean("range_check", ssao.range_check);
  return ssao;
}

void read_exponent(TomlTable& table, Effect& effect) {
  if (const toml::node* node = table.find("exponent"); node && node->is_string()) {
    if (node->value_or("") != std::string("material"))
      table.wrong(*node, "exponent", "a number from 0 to 1e7, or \"material\"");
    effect.exponent_of_material = true;
    return;
  }
  effect.exponent =
      float(table.number("exponent", effect.exponent, 0, 1e7, "a number from 0 to 1e7, or \"material\""));
}

// The names of EXR layers and channels that the picture itself uses.
constexpr std::string_view taken_names[] = {"R", "G", "B", "A", "N", "P", "Z", "AO"};

std::string read_name(TomlTable& table) {
  const std::string name = table.text("name", "");
  const toml::node* node = table.find("name");
  if (!node) return name;
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  if (name.empty() || name.size() > 64 || !std::all_of(name.begin(), name.end(), letter))
    table.wrong(*node, "name", "1 to 64 of the letters a-z, A-Z, 0-9, _ and -");
  if (std::find(std::begin(taken_names), std::end(taken_names), name) != std::end(taken_names))
    fail_at(table.file(), node->source(),
            fmt::format("the name '{}' is taken by a channel of the picture", name));
  return name;
}

// A list of names, or a word for a set that needs no names; `word` of it is returned.
std::vector<std::string> read_set(TomlTable& table, const char* key, const char* expected,
                                  std::string& word) {
  const toml::node* node = table.find(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list) {
    word = node->value_or(std::string());
    if (!node->is_string()) table.wrong(*node, key, expected);
    return {};
  }
  std::vector<std::string> names;
  for (const toml::node& name : *list) {
    names.push_back(name.value_or(std::string()));
    if (!name.is_string() || names.back().empty()) table.wrong(name, key, expected);
  }
  if (names.empty()) table.wrong(*node, key, expected);
  return names;
}

void read_sets(TomlTable& table, Effect& effect) {
  const char* of_occluders = "a list of groups and materials, \"self\" or \"all\"";
  const char* of_receivers = "a list of groups and materials, or \"all\"";
  std::string word = "all";
  effect.occluders = read_set(table, "occluders", of_occluders, word);
  effect.only_self = word == "self";
  if (word != "all" && word != "self") table.wrong(*table.find("occluders"), "occluders", of_occluders);
  word = "all";
  effect.receivers = read_set(table, "receivers", of_receivers, word);
  if (word != "all") table.wrong(*table.find("receivers"), "receivers", of_receivers);
}

void read_traced(TomlTable& table, Effect& effect) {
  effect.sampling = read_sampling(table, effect.kind);
  if (effect.kind == EffectKind::ro) effect.max_distance.kind = DistanceLimit::Kind::none;
  effect.max_distance = table.distance("max_distance", effect.max_distance);
  effect.min_distance =
      float(table.number("min_distance", effect.min_distance, 0, 1e30, "a distance of at least 0"));
  effect.falloff = table.choice<Falloff>("falloff", effect.falloff, falloff_names);
  effect.side = table.choice<Side>("side", effect.side, side_names);
  read_sets(table, effect);
  if (effect.kind == EffectKind::ro) return;
  effect.cone_angle =
      float(table.number("cone_angle", effect.cone_angle, 0, 90, "an angle above 0 and up to 90 degrees"));
  if (effect.cone_angle == 0)
    table.wrong(*table.find("cone_angle"), "cone_angle", "an angle above 0 and up to 90 degrees");
  if (effect.kind != EffectKind::bent) return;
  static constexpr std::pair<std::string_view, bool> spaces[] = {{"world", false}, {"view", true}};
  effect.view_space = table.choice<bool>("space", effect.view_space, spaces);
}

}  // namespace

Effect read_only_effect(TomlTable& renderer, bool realtime) {
  Effect effect;
  effect.kind = read_type(renderer, realtime);
  read_traced(renderer, effect);
  read_exponent(renderer, effect);
  effect.ssao = read_ssao(renderer);
  return effect;
}

Effect read_listed_effect(TomlTable& table, bool realtime) {
  Effect effect;
  if (!table.has("type")) table.missing("type");
  effect.kind = read_type(table, realtime);
  table.set_title(fmt::format("[[effect]] of type \"{}\"", name_of(effect.kind)));
  effect.name = read_name(table);
  if (is_traced(effect.kind)) read_traced(table, effect);
  if (effect.kind == EffectKind::ro) read_exponent(table, effect);
  if (effect.kind == EffectKind::ssao) effect.ssao = read_ssao(table);
  table.finish();
  return effect;
}

}  // namespace nook
