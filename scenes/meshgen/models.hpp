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

/// Trees to be placed many times: an oak of thin folded leaves, a fir of sprays of needles; they stand on
/// y=0.
Model oak();
Model fir();

/// A closed room of about a million triangles, rich in nooks; the camera stands inside.
Model furnished_room();

/// Hard cases; scenes/hard/*.toml say what their pictures must show.
/// A unit sphere that touches a floor at one point; then everything scaled, then moved.
Model hard_contact(double scale, const dvec3& offset);
/// Two plates that meet at 10 degrees.
Model hard_wedge();
/// A closed star of spikes that faces inwards, with edges and vertices everywhere.
Model hard_spikes();
/// A flat floor of triangles up to ten million times longer than wide, with duplicates and triangles without
/// area among them.
Model hard_slivers();

/// The bunny of the package glmark2-data, read from its OBJ file, on a plane. Throws std::runtime_error.
Model bunny_on_plane(const std::filesystem::path& file);

}  // namespace nook::meshgen
