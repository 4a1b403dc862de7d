#pragma once

#include "part.hpp"

// The room's furniture, in the room's coordinates: metres, floor y=0, x in [-3, 3], z in [-2.5, 2.5].
namespace nook::meshgen::room {

constexpr double half_x = 3.0, half_z = 2.5, height = 2.8;

void add_shell(Model& model);      ///< walls, window recess, ceiling beams, tiles, mouldings
void add_bookcase(Model& model);   ///< along the wall z=-2.5
void add_sideboard(Model& model);  ///< with bottles and bowls, along the wall x=-3
void add_dining(Model& model);     ///< table, chairs with woven seats, what is on it, the lamp above
void add_sofa(Model& model);       ///< tufted, with cushions and a basket beside it
void add_textiles(Model& model);   ///< curtains and a braided rug
void add_plants(Model& model);
void add_fittings(Model& model);  ///< radiator, cables, sockets, picture frames

/// A vessel of revolution with a wall: `outline` is (radius, y) from the foot's edge to the rim.
Part vessel(const std::vector<dvec2>& outline, double wall, int segments);

}  // namespace nook::meshgen::room
