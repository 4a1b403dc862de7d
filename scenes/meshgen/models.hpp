#pragma once

#include <filesystem>

#include "part.hpp"

namespace nook::meshgen {

/// The Cornell box of the course's scenes: walls, floor, ceiling, two spheres of radius 0.33; open in front,
/// without a lamp.
Model cornell_box();
/// A landed spaceship before a curved backdrop, posed for the camera of the course's third assignment.
Model spaceship();

/// Pickets, wires and leaves millimetres thick before shelves: what screen-space methods take for walls.
Model fence();

/// A closed room of about a million triangles, rich in nooks; the camera stands inside.
Model furnished_room();

/// The bunny of the package glmark2-data, read from its OBJ file, on a plane. Throws std::runtime_error.
Model bunny_on_plane(const std::filesystem::path& file);

}  // namespace nook::meshgen
