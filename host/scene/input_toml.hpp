#pragma once

#include "scene/scene.hpp"
#include "scene/toml_table.hpp"

namespace nook {

/// Reads what the scene is made of: [input] objfile (a name or a list), [[instance]] and [ground]. Throws
/// Error(scene).
void read_input(TomlTable& input, TomlTable& ground, const toml::node* instances, Scene& scene);

}  // namespace nook
