#pragma once

#include <cstddef>

#include "film/film.hpp"
#include "math/types.hpp"

namespace nook {

/// Where a surface point is open to: the mean of its unoccluded directions, and a cone about it.
struct BentCone {
  vec3 direction{0};     ///< unit; 0 where no direction is open
  float half_angle = 0;  ///< degrees, 0 to 90
};

/// From the film of an effect of type bent (`extra` holds Σ w V ω). With B = ∫ V ω N.ω dω / ∫ V N.ω dω, the
/// direction is B/|B|, and the cone is the one about a normal whose open directions, cosine-weighted, have
/// the same mean length:
///   |B| = 2/3 (1 - c³)/(1 - c²) = 2/3 (1 + c + c²)/(1 + c),  c = cos(half angle)
/// from 1 for a single direction to 2/3 for a hemisphere; what is more scattered than a hemisphere counts as
/// one. Of uniform weights (Film::settings), B = ∫ V ω dω / ∫ V dω and |B| = (1 + c)/2, from 1 to 1/2 (Klehm
/// et al. 2011, "Bent Normals and Cones in Screen-space").
BentCone bent_cone(const Film& film, std::size_t pixel);

}  // namespace nook
