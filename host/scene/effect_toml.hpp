#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/toml_table.hpp"

namespace nook {

/// The one effect of a scene without [[effect]] tables, from [renderer]. TinyRender's keys of other types are
/// accepted there. Throws Error(scene), as all of these.
Effect read_only_effect(TomlTable& renderer, bool realtime);

/// One [[effect]] table: its type decides which keys it may have.
Effect read_listed_effect(TomlTable& table, bool realtime);

/// All of a list of them; no two have one name.
std::vector<Effect> read_effect_list(const std::string& file, const toml::node& list, bool realtime);

}  // namespace nook
