#pragma once

#include "part.hpp"

namespace nook::meshgen {

/// A leaf along +x from its stalk at the origin, facing +y: two sides, folded along the midrib, drooping by
/// `droop` at its end.
Part leaf(double length, double width, double droop);

}  // namespace nook::meshgen
