#pragma once

#include <optional>
#include <span>

#include "math/types.hpp"

namespace nook {

/// A point that sees the whole of a counter-clockwise outline: every edge passes it strictly on its left, and
/// the edges go round it once; exactly. Such an outline does not cross itself, since each ray from the point
/// meets it once. Tried are the mean of the corners and the middle of the kernel, so that a kernel that is
/// hardly wider than rounding may be missed.
std::optional<dvec2> star_centre(std::span<const dvec2> outline);

}  // namespace nook
