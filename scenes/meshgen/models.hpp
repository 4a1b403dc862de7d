#pragma once

#include <filesystem>

#include "part.hpp"

namespace nook::meshgen {

/// The Cornell box of the course's scenes: walls, floor, ceiling, two spheres of radius 0.33; open in front,
/// without a lamp.
Model cornell_box();
/// A landed spaceship before a curved backdrop, posed for the camera of the course's third assignment.
Model spaceship();

}  // namespace nook::meshgen
