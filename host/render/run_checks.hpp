#pragma once

#include <cstddef>
#include <optional>

#include "scene/effect_keys.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What of a scene's keys cannot be rendered together, known before anything is loaded: a stop rule with a
/// sampler that it cannot use, a filter without a variance to steer it.
std::optional<Conflict> conflict_of_run(const Scene& scene);

/// What a stop rule remembers of a pixel and effect, at most: nine planes and a variance.
inline constexpr std::size_t largest_rule_bytes = 10 * 8;

/// Throws Error(device) if the picture needs more memory than there is. aovs: channels asked for besides.
void check_memory(const Scene& scene, std::size_t aovs, std::size_t bytes_a_pixel_of_rule);

}  // namespace nook
