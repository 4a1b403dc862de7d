#pragma once

#include <filesystem>

#include "scene/scene.hpp"

namespace nook {

/// Picture `index` of `count` along a full turn about the axis through `at` along `up`: the eye is turned by
/// 360 index / count degrees, counter-clockwise seen against `up`. Picture 0 is the camera itself, to the
/// bit.
Camera turned_camera(const Camera& camera, unsigned index, unsigned count);

/// "out.exr" -> "out_0007.exr": four digits, more if `count` needs them. An empty path stays empty.
std::filesystem::path numbered_file(const std::filesystem::path& file, unsigned index, unsigned count);

}  // namespace nook
