#pragma once

#include <span>
#include <vector>

#include "film/film.hpp"
#include "image/image.hpp"
#include "kernels/shared/surface_point.h"
#include "plan/plan.hpp"

namespace nook {

/// Filters the values of the plan's effects in a picture (image/denoise.hpp): AO and RO, and of bent normals
/// their AO. `surface`: one point per pixel of the window, row-major; `films`: by effect, for their variance.
/// What is filtered is the mean over the camera rays that hit the mesh, so that a silhouette keeps its share
/// of background; a pixel whose centre sees none stays as it is.
void denoise_picture(const Plan& plan, std::span<const Film> films, std::span<const SurfacePoint> surface,
                     Image& image);

/// The denoised values of one film of a whole picture's window, one point per pixel as above.
std::vector<float> denoised_values(const Film& film, std::span<const SurfacePoint> surface);

}  // namespace nook
