#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace nook {

/// The effect that is R, G, B in the picture: the first that is not SSAO, or the first.
std::size_t main_effect(const Scene& scene);

/// The EXR channels' prefix of each effect: its own name, else its type, numbered if that is taken:
/// "contact."; empty for a main effect without a name (bent normals have channels beyond R, G, B).
std::vector<std::string> layer_prefixes(const Scene& scene);

/// What an effect is called where people read it: its layer's name, or its type.
std::string effect_label(EffectKind kind, const std::string& layer_prefix);

}  // namespace nook
