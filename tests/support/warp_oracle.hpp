#pragma once

#include "device/warps.hpp"

namespace nook::test {

/// What kernels/sample/warp.cl should produce, derived anew in double precision and in polar coordinates (the
/// kernels use concentric squares): the density, and the transform to a uniform pair
///   ( P(angle from +z < theta(w)), phi(w) / 2 pi ).
double oracle_pdf(Warp warp, const dvec3& w, double exponent);
glm::dvec2 oracle_cdf(Warp warp, const dvec3& w, double exponent);

/// The inverse of oracle_cdf: the direction of a uniform pair.
dvec3 oracle_direction(Warp warp, const glm::dvec2& u, double exponent);

}  // namespace nook::test
