#include "scene/effect_keys.hpp"

#include <fmt/format.h>

namespace nook {
namespace {

using Form = Domain::Form;

constexpr EffectKinds ro{EffectKind::ro}, bent{EffectKind::bent}, ssao{EffectKind::ssao};
constexpr std::string_view limit_words[] = {"auto", "none"}, auto_word[] = {"auto"},
                           material_word[] = {"material"}, all_words[] = {"all"},
                           set_words[] = {"all", "self"};
constexpr std::pair<std::string_view, bool> space_names[] = {{"world", false}, {"view", true}};
constexpr std::pair<std::string_view, bool> weight_names[] = {{"cosine", false}, {"uniform", true}};
constexpr Domain distance{.lo = 0, .hi = 1e30, .noun = "a distance", .unit = "world units"};

// A list of names; an empty one is the word "all".
template <auto List>
constexpr Field<Effect> set_of_names() {
  return {[](const Effect& e) { return (e.*List).empty() ? KeyValue("all") : KeyValue(e.*List); },
          [](Effect& e, const KeyValue& value) {
            const auto* names = std::get_if<std::vector<std::string>>(&value);
            e.*List = names ? *names : std::vector<std::string>();
          }};
}

constexpr Field<Effect> occluders{[](const Effect& e) {
                                    return e.only_self ? KeyValue("self")
                                                       : set_of_names<&Effect::occluders>().get(e);
                                  },
                                  [](Effect& e, const KeyValue& value) {
                                    e.only_self = value == KeyValue("self");
                                    set_of_names<&Effect::occluders>().set(e, value);
                                  }};

constexpr Field<Effect> exponent{
    [](const Effect& e) { return e.exponent_of_material ? KeyValue("material") : KeyValue(e.exponent); },
    [](Effect& e, const KeyValue& value) {
      e.exponent_of_material = std::holds_alternative<std::string>(value);
      if (!e.exponent_of_material) unpack(value, e.exponent);
    }};

constexpr Field<Effect> space{
    [](const Effect& e) { return KeyValue(std::string(name_of<bool>(space_names, e.view_space))); },
    [](Effect& e, const KeyValue& value) {
      e.view_space = *value_of<bool>(space_names, std::get<std::string>(value));
    }};

constexpr Field<Effect> weight{
    [](const Effect& e) { return KeyValue(std::string(name_of<bool>(weight_names, e.uniform_weight))); },
    [](Effect& e, const KeyValue& value) {
      e.uniform_weight = *value_of<bool>(weight_names, std::get<std::string>(value));
    }};

// A radius of 0 is "auto".
constexpr Field<Effect> radius{
    [](const Effect& e) { return e.ssao.radius > 0 ? KeyValue(e.ssao.radius) : KeyValue("auto"); },
    [](Effect& e, const KeyValue& value) { unpack(value, e.ssao.radius); }};

const Key<Effect> keys[] = {
    {{.name = "type",
      .domain = choice<effect_names>(),
      .help = "what is estimated; see [effects](effects.md)",
      .default_says = "`ao` (`ssao` if realtime)",
      .record = "effect",
      .of_nook = false},
     field<Effect, &Effect::kind>()},
    {{.name = "name",
      .domain = {.form = Form::text, .noun = "1 to 64 of the letters a-z, A-Z, 0-9, _ and -"},
      .help = "EXR layer in a list; without one the type, numbered if there are several",
      .default_says = "the type"},
     {[](const Effect& e) { return e.name.empty() ? KeyValue() : KeyValue(e.name); },
      [](Effect& e, const KeyValue& value) { e.name = std::get<std::string>(value); }}},
    {{.name = "sampling_type",
      .domain = choice<sampling_names>(),
      .readers = traced_kinds,
      .help =
          "the distribution of directions; `lobe` and `mixture` + are ro's; see [estimators](estimators.md)",
      .flag = "--sampling",
      .record = "sampling",
      .of_nook = false},
     field<Effect, &Effect::sampling>()},
    {{.name = "weight",
      .domain = choice<weight_names>(),
      .readers = ambient_kinds,
      .help = "of an open direction: the cosine of its angle to the normal, or `uniform`: all count alike; "
              "implies "
              "hemisphere sampling",
      .flag = "--weight",
      .elsewhere = "RO weighs by its lobe, SSAO's methods by the cosine alone",
      .define = "WEIGHT",
      .of_type = true},
     weight},
    {{.name = "max_distance",
      .domain = {.lo = 0, .noun = "a distance", .unit = "world units", .words = limit_words},
      .readers = traced_kinds,
      .help =
          "how far occlusion looks; `\"auto\"`: half the radius of the mesh's bounding sphere (ro: no limit)",
      .flag = "--max-distance"},
     field<Effect, &Effect::max_distance>()},
    {{.name = "min_distance",
      .domain = distance,
      .readers = traced_kinds,
      .help = "nearer surfaces do not occlude; below max_distance"},
     field<Effect, &Effect::min_distance>()},
    {{.name = "falloff",
      .domain = choice<falloff_names>(),
      .readers = traced_kinds,
      .help = "how an occluder's distance counts; needs a finite max_distance",
      .define = "FALLOFF"},
     field<Effect, &Effect::falloff>()},
    {{.name = "side",
      .domain = choice<side_names>(),
      .readers = traced_kinds,
      .help =
          "`normal`: the shading normal's side; `inside`: the other, for thickness; `viewer`: the side that "
          "the camera sees",
      .define = "SIDE"},
     field<Effect, &Effect::side>()},
    {{.name = "cone_angle",
      .domain = {.lo = 0, .hi = 90, .above = true, .noun = "an angle", .unit = "degrees"},
      .readers = ambient_kinds,
      .help =
          "half-angle of a cone about the normal: nothing outside it counts; cosine and hemisphere sampling",
      .of_type = true},
     field<Effect, &Effect::cone_angle>()},
    {{.name = "occluders",
      .domain = {.form = Form::names,
                 .noun = "a list of groups and materials, \"self\" or \"all\"",
                 .words = set_words},
      .readers = traced_kinds,
      .help = "what occludes: `\"all\"`, `\"self\"` (each OBJ group itself alone), or groups and materials"},
     occluders},
    {{.name = "receivers",
      .domain = {.form = Form::names,
                 .noun = "a list of groups and materials, or \"all\"",
                 .words = all_words},
      .readers = traced_kinds,
      .help = "where it is estimated: `\"all\"`, or groups and materials; 0 elsewhere"},
     set_of_names<&Effect::receivers>()},
    {{.name = "exponent",
      .domain = {.lo = 0, .hi = 1e7, .words = material_word},
      .readers = ro,
      .help =
          "of the Phong lobe; `\"material\"` +: each surface's `Ns` from the MTL file; a surface without a "
          "lobe traces nothing",
      .flag = "--exponent",
      .of_nook = false},
     exponent},
    {{.name = "space",
      .domain = choice<space_names>(),
      .readers = bent,
      .help = "axes of the direction; `view`: the camera's right, up and back",
      .of_type = true},
     space},
    {{.name = "method",
      .domain = choice<ssao_method_names>(),
      .readers = ssao,
      .help = "how it is computed; see [screen-space AO](ssao.md)",
      .flag = "--method"},
     field<Effect, &Effect::ssao, &SsaoSettings::method>()},
    {{.name = "quality",
      .domain = choice<ssao_quality_names>(),
      .readers = ssao,
      .help = "without it, the method as the assignment has it",
      .flag = "--quality"},
     field<Effect, &Effect::ssao, &SsaoSettings::quality>()},
    {{.name = "radius",
      .domain =
          {.lo = 0, .hi = 1e30, .above = true, .noun = "a radius", .unit = "world units", .words = auto_word},
      .readers = ssao,
      .help = "`\"auto\"`: half the radius of the bounding sphere",
      .flag = "--radius"},
     radius},
    {{.name = "bias", .domain = distance, .readers = ssao, .help = "nearer surfaces do not occlude"},
     field<Effect, &Effect::ssao, &SsaoSettings::bias>()},
    {{.name = "samples", .domain = integer(1, 32), .readers = ssao, .help = "directions a pixel"},
     field<Effect, &Effect::ssao, &SsaoSettings::samples>()},
    {{.name = "range_check",
      .domain = yes_or_no,
      .readers = ssao,
      .help = "`point`: occluders beyond the radius do not count"},
     field<Effect, &Effect::ssao, &SsaoSettings::range_check>()},
};

}  // namespace

std::span<const Key<Effect>> effect_keys() {
  return keys;
}

Effect default_effect(EffectKind kind) {
  Effect effect;
  effect.kind = kind;
  if (kind == EffectKind::ro) {
    effect.sampling = Sampling::lobe;
    effect.max_distance.kind = DistanceLimit::Kind::none;
  }
  return effect;
}

bool is_given(const Effect& effect, std::string_view name) {
  for (std::size_t k = 0; k < std::size(keys); ++k)
    if (keys[k].info.name == name) return effect.given >> k & 1;
  return false;
}

void give(Effect& effect, const Key<Effect>& key, const KeyValue& value) {
  key.field.set(effect, value);
  effect.given |= std::uint64_t(1) << (&key - keys);
}

void settle(Effect& effect) {
  if (is_given(effect, "sampling_type")) return;
  const bool uniform = ambient_kinds.contains(effect.kind) && effect.uniform_weight;
  effect.sampling = uniform ? Sampling::hemisphere : default_effect(effect.kind).sampling;
}

std::optional<Conflict> conflict_of(const Effect& e) {
  const bool of_ro = e.sampling == Sampling::lobe || e.sampling == Sampling::mixture;
  if (e.kind != EffectKind::ro && of_ro)
    return Conflict{"sampling_type", fmt::format("\"{}\" needs type \"ro\"", name_of(e.sampling))};
  if (ambient_kinds.contains(e.kind) && e.cone_angle < 90 && e.sampling == Sampling::sphere)
    return Conflict{"cone_angle", "needs sampling_type cosine or hemisphere"};
  if (ambient_kinds.contains(e.kind) && e.uniform_weight && e.sampling == Sampling::cosine)
    return Conflict{
        "weight",
        "\"uniform\" needs sampling_type hemisphere or sphere: directions drawn by the cosine would have "
        "weights without bound"};
  return std::nullopt;
}

std::vector<Sampling> samplings_of(const Effect& effect) {
  std::vector<Sampling> samplings;
  for (const Sampling sampling :
       {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    Effect sampled = effect;
    sampled.sampling = sampling;
    if (!conflict_of(sampled)) samplings.push_back(sampling);
  }
  return samplings;
}

}  // namespace nook
