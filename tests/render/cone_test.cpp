// AO within a cone about the normal, against closed forms. Receiver at the origin, normal +z. Under an
// endless ceiling at height h, a direction at cosine m to the normal meets it at t = h/m; with c = h/R (R the
// distance limit) cosine-weighted values are integrals over 2 m dm, and the directions with m < c are open.
#include <gtest/gtest.h>

#include "effects_geometry.hpp"

namespace nook::test {
namespace {

constexpr double c = 0.5;  // h = 1, R = 2

// In the cone of half-angle a, the open m go from cos a to c: (c² - cos² a) / sin² a; at 45 degrees none.
TEST(Cone, ConeOfDirections) {
  for (const Sampling sampling : {Sampling::cosine, Sampling::hemisphere}) {
    Effect effect = ao_within(2);
    effect.sampling = sampling;
    effect.cone_angle = 75;
    const double cos2 = std::pow(std::cos(75 * M_PI / 180), 2);
    expect_value(estimate_at_origin(plane_at(1), effect), (c * c - cos2) / (1 - cos2));
    effect.cone_angle = 45;
    EXPECT_EQ(estimate_at_origin(plane_at(1), effect).value(0), 0);
    EXPECT_NEAR(estimate_at_origin(plane_at(3), effect).value(0), 1,
                sampling == Sampling::cosine ? 0 : 0.005);
  }
}

}  // namespace
}  // namespace nook::test
