// How many directions a camera ray is worth, against the cost of all numbers that might have been chosen.
#include "adaptive/directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nook {
namespace {

// Camera rays N to a variance of 1, (between + within D^-1.25) N^-1.25, and their cost N (2 + D).
TEST(Directions, AreTheCheapest) {
  const auto cost = [](double between, double within, double directions) {
    const double rays = std::pow(between + within / std::pow(directions, 1.25), 0.8);
    return rays * (2 + directions);
  };
  for (double between = 1e-5; between < 1; between *= 1.7)
    for (double within = 1e-4; within < 1; within *= 2.3) {
      const DirectionChoice made = cheapest_directions(between, within, {});
      for (double other = 1; other <= 64; other *= 2)
        EXPECT_LE(cost(between, within, made.directions), cost(between, within, other) * (1 + 1e-12))
            << between << " " << within << ": " << made.directions << " and not " << other;
    }
}

TEST(Directions, HaveLimits) {
  EXPECT_EQ(cheapest_directions(0, 0, {}).directions, 1u);      // nothing varies
  EXPECT_EQ(cheapest_directions(.1, 0, {}).directions, 1u);     // edges alone
  EXPECT_EQ(cheapest_directions(.1, -.01, {}).directions, 1u);  // a pilot's noise
  EXPECT_EQ(cheapest_directions(0, .1, {}).directions, 64u);
  EXPECT_EQ(cheapest_directions(-.01, .1, {}).directions, 64u);
}

// A pixel that few directions suffice for has camera rays all the same: 24 of them.
TEST(Directions, LeaveCameraRaysForAnError) {
  EXPECT_EQ(cheapest_directions(1e-6, .25, .1).directions, 1u);
  EXPECT_LT(cheapest_directions(1e-6, .25, .03).directions, cheapest_directions(1e-6, .25, .01).directions);
  EXPECT_EQ(cheapest_directions(1e-6, .25, .001).directions, 64u);
}

}  // namespace
}  // namespace nook
