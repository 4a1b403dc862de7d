#pragma once

#include <string>

#include "scene/key.hpp"

namespace nook {

/// What help says of a key: its line of docs/scene-format.md without Markdown, and the values it may have.
std::string help_text(const KeyInfo& key);

}  // namespace nook
