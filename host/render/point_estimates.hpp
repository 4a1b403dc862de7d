#pragma once

#include "trace/occlusion_tracer.hpp"

namespace nook {

/// How many randomisations the directions at a point are split into, so that their spread tells the
/// estimate's error: the samples of a point set vary more than its means do. As many as divide `directions`
/// from 16 down to 8; 1 for independent samples, whose own spread tells, and where none divides. Of a set of
/// given points (Plan::point_set), whose multiple `directions` must be: as often as it is taken.
std::uint32_t randomisations_at_points(const Plan& plan, std::uint32_t directions);

/// OcclusionTracer::estimate_all() whose films' variance is true for every point sequence: replicates are
/// randomisations (Randomisations::seed_of), or directions where there is one. Plane 0 of Film::kept is
/// Σ x² / EffectPlan::weight_bound over the directions' x, in the fixed point of Film::sum.
std::vector<Film> estimate_at_points(OcclusionTracer& tracer, const Plan& plan,
                                     std::span<const SurfacePoint> points, std::uint32_t directions,
                                     const OcclusionTracer::Progress& progress = nullptr);

/// The standard error to tell of a point's estimate, of estimate_at_points()'s film: 1.96 of it to each side
/// hold the value in 93 to 97 % of the cases where some, but not all, of the samples count.
///
/// Its square is t²/z² times film.variance(), t being Student's quantile for so few replicates, and
///   2.5 (1 - 2p)² c² / n² / (1 + (k/20)²),   c = Σx² / Σx,  p = x̄/c,  k = n p (1 - p).
/// x/c has the variance of a Bernoulli variable (score_interval()), and this is what z sqrt(p (1 - p) / n)
/// with p = (k + 2.5) / (n + 5) has more than with p = k/n (CountRule): the spread of a few hits shows
/// nothing of the hits that there might have been. From k = 20 on the spread knows. c is taken as if a tenth
/// of a sample of the largest weight, `weight_bound`, had been met too: where the effective hits (Σx)² / Σx²
/// are below about five, the heaviest may all have been missed, and intervals hold more often than said. With
/// no hit or all hits 1.96 of it is 3.1 c / n (Hanley and Lippman-Hand 1983: 3/n).
double standard_error(const Film& film, std::size_t point, double weight_bound);

}  // namespace nook
