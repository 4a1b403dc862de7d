#pragma once

#include <span>

#include "math/types.hpp"

namespace nook {

/// By how much the rounding of a file's numbers may have moved an outline's corners: 10^-6 of its extent.
double outline_tolerance(std::span<const dvec2> outline);

/// Whether two edges of a closed outline cross: each has an end on either side of the other, by more than the
/// outline's tolerance. Edges that touch, or lie on one another, do not cross. A tree of boxes along the
/// outline leads to pairs that may; of outlines that keep it busier than some 100 pairs an edge it is not
/// found out (false).
bool outline_crosses(std::span<const dvec2> outline);

}  // namespace nook
