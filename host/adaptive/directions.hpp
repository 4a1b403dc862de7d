#pragma once

#include <optional>
#include <string>

#include "plan/plan.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {

/// How many directions a camera ray is worth, and why.
struct DirectionChoice {
  std::uint32_t directions = 1;
  double between = 0;  ///< variance of a camera ray's expected value within its pixel, the mean over pixels
  double within = 0;   ///< variance of one direction's sample at a camera ray, the same mean
};

/// The cheapest directions a camera ray. N camera rays of D directions each are points of a randomised net,
/// with a pixel's variance and cost about
///   (between + within D^-r) N^-r   and   N (c + D),
/// r = 1.25, c = 2 being about the cost of a camera ray in directions (bench/journal.md, "The price of
/// knowing an error"): to one variance it is the power of two up to 64 with the least (between + within
/// D^-r)^(1/r) (c + D). For independent points, r = 1, that is Cochran's sqrt(c within / between) (1977,
/// "Sampling techniques", section 10.6). To an `error` of pixels D is also so small that they take 24 camera
/// rays, as far as the variances tell. c is no measurement of the day, so that the choice, and with it the
/// picture, depends on no clock.
DirectionChoice cheapest_directions(double between, double within, std::optional<double> error);

/// "16: the variance between camera rays is .00054, between directions of one .15": for people.
std::string why(const DirectionChoice& choice);

/// That for a plan, from a pilot on about 4096 pixels: 8 camera rays of one direction, then 8 of 64. Of
/// several effects their mean counts, each by its own variance. Leaves the tracer with plan.spp samples of
/// plan.seed and the directions chosen. plan: without replicate_directions.
DirectionChoice choose_directions(OcclusionTracer& tracer, const Plan& plan, std::optional<double> error);

}  // namespace nook
