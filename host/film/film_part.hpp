#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "film/film.hpp"
#include "film/sample_boxes.hpp"
#include "image/image.hpp"

namespace nook {

/// What a part of a render counted.
struct TraceCounts {
  std::uint64_t camera_rays = 0;
  std::uint64_t occlusion_rays = 0;
  std::uint64_t rejected = 0;  ///< estimates that were not finite: kept out of the film
};

/// Some of a picture's samples, and all that is needed to go on, to join it with others, or to make the
/// picture of it. A checkpoint, a shard and a finished film are all this; see docs/checkpoints.md for the
/// file.
struct FilmPart {
  using Texts = std::vector<std::pair<std::string, std::string>>;

  Texts identity;  ///< everything that decides bits, by name ("seed" -> "7"): only parts that agree in all of
                   ///< it join
  Texts metadata;  ///< for the EXR header
  std::vector<std::string> layers;      ///< of each film: its EXR channels' prefix; "" for R, G, B
  std::vector<std::string> aovs;        ///< channels asked for besides, as --aov names them
  std::uint32_t samples_per_pixel = 1;  ///< of the whole picture, at most
  std::vector<Film> films;              ///< one per effect, all of one size
  SampleBoxes held;                     ///< in the films; canonical
  SampleBoxes
      planned;  ///< the step under way: what of it is not held comes before any new decision; canonical
  bool finished = false;  ///< a stop rule found it good enough, held or not
  TraceCounts counts;
  double render_seconds = 0;
  std::vector<Channel>
      surface;  ///< finished channels of the pixels' centres (normal, position, depth), if asked for

  /// All that the whole picture has.
  SampleBox whole() const { return {0, std::uint32_t(films.front().pixels()), 0, samples_per_pixel}; }
  bool complete() const { return finished || subtract({whole()}, held).empty(); }
};

}  // namespace nook
