#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/key.hpp"

namespace nook {

/// Every key of an effect, described once.
std::span<const Key<Effect>> effect_keys();

/// An effect of the type with every key at its default.
Effect default_effect(EffectKind kind);

/// Sets a key's value, and that it was given.
void give(Effect& effect, const Key<Effect>& key, const KeyValue& value);
bool is_given(const Effect& effect, std::string_view key);

/// What some keys decide for others: settings that were not given follow from those that were.
void settle(Effect& effect);

/// Settings that exclude one another.
struct Conflict {
  std::string_view key;  ///< one of them
  std::string what;
};
std::optional<Conflict> conflict_of(const Effect& effect);

/// The distributions that the effect, as it is otherwise, can be sampled by, the best first.
std::vector<Sampling> samplings_of(const Effect& effect);

/// The keys that the effect's type reads and their values, in the order of effect_keys(); without `type` and
/// `name`.
std::vector<std::pair<const KeyInfo*, KeyValue>> settings_of(const Effect& effect);

/// For one line of a report: sampling and distance, then all that is not at its default, with units:
/// "sampling cosine, max_distance 0.5, falloff smooth, cone_angle 60 degrees".
std::string settings_text(const Effect& effect);

}  // namespace nook
