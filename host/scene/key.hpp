#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>

#include "scene/key_value.hpp"
#include "scene/names.hpp"

namespace nook {

/// Some of the types of effects.
class EffectKinds {
 public:
  constexpr EffectKinds(std::initializer_list<EffectKind> kinds) {
    for (const EffectKind kind : kinds) bits_ |= 1u << unsigned(kind);
  }
  constexpr bool contains(EffectKind kind) const { return bits_ >> unsigned(kind) & 1; }
  constexpr bool intersects(EffectKinds other) const { return (bits_ & other.bits_) != 0; }
  constexpr bool operator==(const EffectKinds&) const = default;

 private:
  unsigned bits_ = 0;
};

inline constexpr EffectKinds ambient_kinds{EffectKind::ao, EffectKind::bent};
inline constexpr EffectKinds traced_kinds{EffectKind::ao, EffectKind::bent, EffectKind::ro};
inline constexpr EffectKinds all_kinds{EffectKind::ao,     EffectKind::ro,       EffectKind::ssao,
                                       EffectKind::normal, EffectKind::position, EffectKind::depth,
                                       EffectKind::bent};

/// What there is to know of a key of a scene file but for where its value is kept. Reading, writing, flags,
/// variables, records, reports and docs/scene-format.md follow from it.
struct KeyInfo {
  std::string_view name;
  Domain domain;
  EffectKinds readers = all_kinds;     ///< effects that it changes
  std::string_view help;               ///< one line of Markdown, as docs/scene-format.md has it
  std::string_view flag = "";          ///< of the command line: "--max-distance"; empty: none
  std::string_view default_says = "";  ///< in the docs, where the value itself says too little
  std::string_view needs = "";         ///< the message where Key::applies does not hold
  std::string_view elsewhere = "";     ///< said to who gives it to an effect that does not read it
  std::string_view define = "";        ///< of kernels: the macro that is the number of a choice's word
  std::string_view record = "";        ///< its name in attributes and run records; empty: `name`
  bool of_nook = true;                 ///< nook's own; false: TinyRender has it
  bool of_type = false;                ///< refused in [renderer] where the effect there does not read it
  bool of_samples = true;              ///< decides what is sampled, and so belongs to the scene's hash

  /// "NOOK_MAX_DISTANCE"; empty without a flag.
  std::string variable() const;
  std::string_view recorded_as() const { return record.empty() ? name : record; }
};

/// Where a key's value is kept. Both are total: get() of what set() took is the same value.
template <class Owner>
struct Field {
  KeyValue (*get)(const Owner&);
  void (*set)(Owner&, const KeyValue&);
};

template <class Owner>
struct Key {
  KeyInfo info;
  Field<Owner> field;
  bool (*applies)(const Owner&) = nullptr;  ///< whether it can be given beside the others; null: always

  bool in_use(const Owner& owner) const { return !applies || applies(owner); }
};

// Values of the types that scenes are made of.
template <class T>
KeyValue packed(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return std::string(name_of(value));
  else if constexpr (std::is_same_v<T, bool>)
    return value;
  else if constexpr (std::is_integral_v<T>)
    return std::int64_t(value);
  else
    return value;
}

template <class T>
KeyValue packed(const std::optional<T>& value) {
  return value ? packed(*value) : KeyValue();
}

inline KeyValue packed(const View& view) {
  return to_string(view);
}
inline KeyValue packed(const Background& background) {
  return to_string(background);
}

inline KeyValue packed(const DistanceLimit& limit) {
  return limit.kind == DistanceLimit::Kind::value ? KeyValue(limit.value) : KeyValue(to_string(limit));
}

template <class T>
void unpack(const KeyValue& value, T& to) {
  if constexpr (std::is_enum_v<T>)
    to = *value_of(names_of(to), std::get<std::string>(value));
  else if constexpr (std::is_same_v<T, bool>)
    to = std::get<bool>(value);
  else if constexpr (std::is_integral_v<T>)
    to = T(std::get<std::int64_t>(value));
  else if constexpr (std::is_floating_point_v<T>)
    to = std::visit(
        [](const auto& v) {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(v)>>)
            return T(v);
          else
            return T();
        },
        value);
  else if constexpr (std::is_same_v<T, vec3> || std::is_same_v<T, dvec3>)
    to = std::holds_alternative<dvec3>(value) ? T(std::get<dvec3>(value)) : T(std::get<vec3>(value));
  else
    to = std::get<T>(value);
}

/// Nothing, or a word in the number's place: unset.
template <class T>
void unpack(const KeyValue& value, std::optional<T>& to) {
  to.reset();
  if (std::holds_alternative<std::monostate>(value)) return;
  if (!std::is_enum_v<T> && std::holds_alternative<std::string>(value)) return;
  unpack(value, to.emplace());
}

inline void unpack(const KeyValue& value, View& to) {
  to = *parse_view(std::get<std::string>(value));
}
inline void unpack(const KeyValue& value, Background& to) {
  to = *parse_background(std::get<std::string>(value));
}

inline void unpack(const KeyValue& value, DistanceLimit& to) {
  if (const std::string* word = std::get_if<std::string>(&value)) {
    to = *parse_distance_limit(*word);
  } else {
    to.kind = DistanceLimit::Kind::value;
    unpack(value, to.value);
  }
}

/// The value at owner.*First.*Rest...
template <auto First, auto... Rest, class Owner>
auto& member(Owner& owner) {
  if constexpr (sizeof...(Rest) == 0)
    return owner.*First;
  else
    return member<Rest...>(owner.*First);
}

template <class Owner, auto... Path>
constexpr Field<Owner> field() {
  return {[](const Owner& owner) { return packed(member<Path...>(owner)); },
          [](Owner& owner, const KeyValue& value) { unpack(value, member<Path...>(owner)); }};
}

/// The names of a table of names.hpp, for Domain::words.
template <const auto& Table>
inline constexpr auto words_of = [] {
  std::array<std::string_view, std::size(Table)> words;
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = Table[i].first;
  return words;
}();

template <const auto& Table>
constexpr Domain choice() {
  return {.form = Domain::Form::choice, .words = words_of<Table>};
}

inline constexpr Domain yes_or_no{.form = Domain::Form::boolean};

constexpr Domain integer(double lo, double hi, std::string_view unit = "") {
  return {.form = Domain::Form::integer, .lo = lo, .hi = hi, .unit = unit};
}

}  // namespace nook
