#pragma once

#include <string>

#include "scene/scene.hpp"

namespace nook {

/// The scene as TOML, every key that its effects read with its value: what --print-config prints. Read again,
/// it is the same scene. Mesh files are named as the scene has them.
std::string to_toml(const Scene& scene);

/// 128 bits over what of to_toml() decides the samples: not the file names, nor how long to render. 32
/// hexadecimal digits.
std::string scene_hash(const Scene& scene);

}  // namespace nook
