#pragma once

#include <span>
#include <string>
#include <vector>

#include "film/film_part.hpp"
#include "image/image.hpp"
#include "kernels/shared/surface_point.h"
#include "plan/plan.hpp"

namespace nook {

/// Channels beside the estimate, on request.
struct AovRequest {
  bool normal = false;    ///< N.X, N.Y, N.Z: shading normal at the pixel's centre, 0 where nothing is hit
  bool position = false;  ///< P.X, P.Y, P.Z: world units, at the pixel's centre, 0 where nothing is hit
  bool depth =
      false;  ///< Z: distance along the view axis at the pixel's centre, infinity where nothing is hit
  bool variance = false;  ///< AO.variance: of the pixel's estimate
  bool samples = false;   ///< AO.samples: occlusion directions drawn
  bool alpha = false;     ///< A: share of camera rays that hit the mesh
  bool needs_surface() const { return normal || position || depth; }
};

/// "normal,position,depth,variance,samples,alpha" in any order. Throws Error(usage).
AovRequest parse_aovs(const std::vector<std::string>& names);

/// The prefix of each effect's channels: "" for the first (R, G, B), the effect's name or "ao2." for a
/// further one.
std::vector<std::string> layer_names(const Plan& plan);

/// The channels of `aovs` that say what lies under the pixels' centres. `surface`: one point per pixel of the
/// window, row-major.
std::vector<Channel> surface_channels(const Plan& plan, const AovRequest& aovs,
                                      std::span<const SurfacePoint> surface);

/// A plane beside those of a part's surface that is no channel of its picture: Image::ground.
constexpr const char* ground_plane = "preview ground";

/// That of a plan with a preview_ground: 1 where a pixel's centre sees the ground, else 0. `surface` as
/// above.
Channel preview_ground(const Plan& plan, std::span<const SurfacePoint> surface);

/// The image of a part, whatever samples it has: R = G = B = the first effect's estimate, further effects in
/// their layers, the AOVs that the part names.
Image make_picture(const FilmPart& part);

/// Says where in the whole image a picture of the plan's window lies.
void place_crop(Image& image, const Plan& plan);
/// The same by a part's identity (film_identity()).
void place_crop(Image& image, const FilmPart::Texts& identity);

}  // namespace nook
