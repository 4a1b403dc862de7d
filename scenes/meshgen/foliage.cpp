#include "foliage.hpp"

#include <cmath>

#include "primitives.hpp"

namespace nook::meshgen {

Part leaf(double length, double width, double droop) {
  const int rows = 8, columns = 12;
  const double thickness = 0.016 * length;
  return shaded(grid(rows, columns,
                     [&](int r, int c) {
                       const double t = double(r) / (rows - 1), a = 2 * pi * c / columns;
                       const double half = 0.5 * width * std::sin(pi * std::pow(t, 0.8));
                       const double across = std::cos(a);
                       return dvec3(length * t,
                                    0.5 * thickness * std::sin(a) * std::sin(pi * t) - droop * t * t +
                                        0.15 * half * across * across,
                                    -half * across);
                     },
                     {.wrap = true}),
                70);
}

}  // namespace nook::meshgen
