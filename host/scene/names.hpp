#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "scene/scene.hpp"

namespace nook {

template <class T>
using NameTable = std::span<const std::pair<std::string_view, T>>;

// One table per enumeration: scene files, flags, metadata and reports all use these names.
inline constexpr std::pair<std::string_view, Sampling> sampling_names[] = {
    {"cosine", Sampling::cosine},
    {"hemisphere", Sampling::hemisphere},
    {"sphere", Sampling::sphere},
    {"lobe", Sampling::lobe},
    {"mixture", Sampling::mixture}};
inline constexpr std::pair<std::string_view, Sampler> sampler_names[] = {
    {"independent", Sampler::independent},
    {"stratified", Sampler::stratified},
    {"halton", Sampler::halton},
    {"sobol", Sampler::sobol},
    {"zorder", Sampler::zorder}};
inline constexpr std::pair<std::string_view, EffectKind> effect_names[] = {{"ao", EffectKind::ao},
                                                                           {"ro", EffectKind::ro},
                                                                           {"ssao", EffectKind::ssao},
                                                                           {"normal", EffectKind::normal},
                                                                           {"position", EffectKind::position},
                                                                           {"depth", EffectKind::depth},
                                                                           {"bent", EffectKind::bent}};
inline constexpr std::pair<std::string_view, Falloff> falloff_names[] = {
    {"none", Falloff::none},
    {"linear", Falloff::linear},
    {"smooth", Falloff::smooth},
    {"exponential", Falloff::exponential}};
inline constexpr std::pair<std::string_view, Side> side_names[] = {
    {"normal", Side::normal}, {"inside", Side::inside}, {"viewer", Side::viewer}};
inline constexpr std::pair<std::string_view, Instancing> instancing_names[] = {
    {"auto", Instancing::automatic}, {"copies", Instancing::copies}, {"tree", Instancing::tree}};
inline constexpr std::pair<std::string_view, Axis> axis_names[] = {
    {"x", Axis::x},        {"y", Axis::y},        {"z", Axis::z},
    {"-x", Axis::minus_x}, {"-y", Axis::minus_y}, {"-z", Axis::minus_z}};
inline constexpr std::pair<std::string_view, View> view_names[] = {
    {"three-quarter", View{}}, {"front", {0, 0}}, {"back", {180, 0}},  {"left", {-90, 0}},
    {"right", {90, 0}},        {"top", {0, 90}},  {"bottom", {0, -90}}};
inline constexpr std::pair<std::string_view, Background> background_names[] = {
    {"transparent", {.transparent = true}},
    {"black", {}},
    {"white", {.red = 255, .green = 255, .blue = 255}},
    {"grey", {.red = 128, .green = 128, .blue = 128}}};
inline constexpr std::pair<std::string_view, SsaoSettings::Method> ssao_method_names[] = {
    {"point", SsaoSettings::Method::point},
    {"gtao", SsaoSettings::Method::gtao},
    {"march", SsaoSettings::Method::march}};
inline constexpr std::pair<std::string_view, SsaoSettings::Quality> ssao_quality_names[] = {
    {"draft", SsaoSettings::Quality::draft},
    {"real-time", SsaoSettings::Quality::real_time},
    {"accurate", SsaoSettings::Quality::accurate}};

template <class T>
std::string_view name_of(NameTable<T> table, T value) {
  for (const auto& [name, entry] : table)
    if (entry == value) return name;
  return "?";
}
// The table of an enumeration.
inline NameTable<Sampling> names_of(Sampling) {
  return sampling_names;
}
inline NameTable<Sampler> names_of(Sampler) {
  return sampler_names;
}
inline NameTable<EffectKind> names_of(EffectKind) {
  return effect_names;
}
inline NameTable<Falloff> names_of(Falloff) {
  return falloff_names;
}
inline NameTable<Side> names_of(Side) {
  return side_names;
}
inline NameTable<Instancing> names_of(Instancing) {
  return instancing_names;
}
inline NameTable<Axis> names_of(Axis) {
  return axis_names;
}
inline NameTable<SsaoSettings::Method> names_of(SsaoSettings::Method) {
  return ssao_method_names;
}
inline NameTable<SsaoSettings::Quality> names_of(SsaoSettings::Quality) {
  return ssao_quality_names;
}

template <class E>
requires std::is_enum_v<E> std::string_view name_of(E value) {
  return name_of<E>(names_of(value), value);
}

template <class T>
std::optional<T> value_of(NameTable<T> table, std::string_view name) {
  for (const auto& [entry, value] : table)
    if (entry == name) return value;
  return std::nullopt;
}

/// The candidate nearest to `word` by edit distance, or "" if none is near (more than half its letters
/// differ).
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// ", did you mean 'exponent'?", or "".
std::string suggestion(std::string_view word, std::span<const std::string_view> candidates);

/// "auto", "none" or a number >= 0; nullopt otherwise.
std::optional<DistanceLimit> parse_distance_limit(const std::string& text);
std::string to_string(const DistanceLimit& limit);

/// A name of view_names, or "AZIMUTH,ELEVATION" in degrees (-360 to 360, -90 to 90); nullopt otherwise.
std::optional<View> parse_view(std::string_view text);
std::string to_string(const View& view);

/// A name of background_names, or "#rrggbb"; nullopt otherwise.
std::optional<Background> parse_background(std::string_view text);
std::string to_string(const Background& background);

/// "-z" -> (0, 0, -1), "0,1,0.5"; nullopt unless it is an axis or three numbers that are finite as floats.
std::optional<dvec3> parse_point(std::string_view text);

}  // namespace nook
