#pragma once

#include <span>

#include "scene/key.hpp"

namespace nook {

// Every key of a scene file's tables but for the effects', described once. Those of [renderer] and [film]
// that only some effects read say so.
std::span<const Key<Scene>> input_keys();
std::span<const Key<Instance>> instance_keys();
std::span<const Key<Ground>> ground_keys();
std::span<const Key<Scene>> camera_keys();
std::span<const Key<Scene>> film_keys();
std::span<const Key<Scene>> renderer_keys();

/// The key, of a table or of an effect, that the flag sets; null if it is no key's.
const KeyInfo* key_of_flag(std::string_view flag);

/// Whether some effect of the scene reads the key.
bool is_read(const KeyInfo& key, const Scene& scene);

/// "with samples", "of type ao, bent or ro": the effects that read the key, as what a scene lacks.
std::string readers_text(const KeyInfo& key);

}  // namespace nook
