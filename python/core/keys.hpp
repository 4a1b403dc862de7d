#pragma once

#include "object.hpp"

namespace nook::python {

/// Every key of a scene that is a keyword: a dict each of name, of ("camera", "film", "renderer", "effect",
/// "input", "ground"), readers (types of effects), default (as TOML, or None), help.
Object keys();

/// What `nook devices` prints: a dict each. Throws Error(device).
Object devices();

}  // namespace nook::python
