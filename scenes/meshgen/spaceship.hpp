#pragma once

#include "hull.hpp"
#include "part.hpp"

// The spaceship's assemblies, in its own coordinates: x to the nose, y up, z to starboard, the ground at y=0.
namespace nook::meshgen::ship {

Hull fuselage();

/// Panelled fuselage, canopy, wings, fins.
void add_airframe(Model& model);
/// Two nacelles with intake fans, and the three ribbed bells.
void add_engines(Model& model);
/// Three legs with pads, braces and doors.
void add_landing_gear(Model& model);
/// Pipes, vents, hatches, bolts, antennas, the turret under the nose.
void add_details(Model& model);

/// Adds the part to starboard and its mirror image to port.
void add_pair(Model& model, const char* group, const char* material, const Part& part, const dmat4& m);

constexpr double nacelle_z = 0.80, nacelle_y = 0.66;

}  // namespace nook::meshgen::ship
