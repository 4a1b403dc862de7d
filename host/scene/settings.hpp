#pragma once

#include <string>

#include "scene/scene.hpp"

namespace nook {

/// What a program sets of a scene that is there, as flags do for a command: lines of TOML, each a key of
/// [camera], [film], [renderer] or of an effect ("spp = 16"); keys of effects are set in every effect that
/// reads them. `type` puts one effect of that type in the place of the scene's, `effect` (an array of tables)
/// a list.
///
/// of_mesh: also what decides the mesh, which cannot change once it is loaded: `cutouts`, `instancing`, and
/// `ground` (a table).
///
/// Throws Error(usage) of no place, in the words of a scene file's errors; also for a key that no effect of
/// the scene reads, and for keys that exclude one another.
void apply_settings(const std::string& lines, bool of_mesh, Scene& scene);

}  // namespace nook
