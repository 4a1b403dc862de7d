#pragma once

#include <filesystem>

#include "part.hpp"

namespace nook::meshgen {

/// The Cornell box of the course's scenes: walls, floor, ceiling, two spheres of radius 0.33; open in front,
/// without a lamp.
Model cornell_box();

}  // namespace nook::meshgen
