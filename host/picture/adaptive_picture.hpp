#pragma once

#include "adaptive/adaptive.hpp"
#include "film/film_part.hpp"
#include "image/image.hpp"
#include "plan/plan.hpp"

namespace nook {

/// The image of a render to an error: `result` is AdaptiveRender::run()'s, `plan` the one it was made with.
/// part: its layers, aovs and surface channels decide which channels there are.
Image adaptive_picture(const Plan& plan, const FilmPart& part, const AdaptiveResult& result);

}  // namespace nook
