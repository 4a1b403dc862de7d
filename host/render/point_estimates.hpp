#pragma once

#include "trace/occlusion_tracer.hpp"

namespace nook {

/// How many randomisations the directions at a point are split into, so that their spread tells the
/// estimate's error: the samples of a point set vary more than its means do. As many as divide `directions`
/// from 16 down to 8; 1 for independent samples, whose own spread tells, and where none divides. Of a set of
/// given points (Plan::point_set), whose multiple `directions` must be: as often as it is taken.
std::uint32_t randomisations_at_points(const Plan& plan, std::uint32_t directions);

/// OcclusionTracer::estimate_all() whose films' variance is true for every point sequence: replicates are
/// randomisations (Randomisations::seed_of), or directions where there is one.
std::vector<Film> estimate_at_points(OcclusionTracer& tracer, const Plan& plan,
                                     std::span<const SurfacePoint> points, std::uint32_t directions,
                                     const OcclusionTracer::Progress& progress = nullptr);

/// The standard error to tell of a point's estimate: that of film.variance(), times what Student's
/// distribution asks for with so few replicates at 95 %. Where nothing varied, the least that 0 of n samples
/// leave possible at 95 % (3/n, Hanley and Lippman-Hand 1983), for weights up to `weight_bound`.
double standard_error(const Film& film, std::size_t point, double weight_bound);

}  // namespace nook
