#include "render/run_checks.hpp"

#include <fmt/format.h>

#include "adaptive/adaptive.hpp"
#include "base/memory.hpp"
#include "kernels/shared/surface_point.h"

namespace nook {

std::optional<Conflict> conflict_of_run(const Scene& scene) {
  const StopTarget& stop = scene.stop;
  if (scene.denoise && !stop.any() && std::uint64_t(scene.spp) * scene.directions < 2)
    return Conflict{"denoise", "needs two samples a pixel or more; their variance steers the filter"};
  if (stop.error && !AdaptiveRender::can_use(scene.sampler))
    return Conflict{"error", fmt::format("works with sampler independent, sobol or halton, not {}",
                                         name_of(scene.sampler))};
  return std::nullopt;
}

// A film has 28 bytes a pixel and effect, and what a stop rule remembers; render order, pixel list and
// positions 4 each; the picture 4 a channel, held twice when it is written, and up to three channels an
// effect or AOV. A denoiser reads the pixels' surface points, and holds 7 floats a pixel of them twice, and 7
// planes of values.
void check_memory(const Scene& scene, std::size_t aovs, std::size_t bytes_a_pixel_of_rule) {
  const PixelRect window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  const std::uint64_t pixels = std::uint64_t(window.width()) * std::uint64_t(window.height());
  const std::uint64_t bytes_a_pixel_of_denoiser =
      scene.denoise ? sizeof(SurfacePoint) + 2 * 4 * 7 + 4 * 7 : 0;
  const std::uint64_t bytes_a_pixel = (28 + bytes_a_pixel_of_rule) * scene.effects.size() + 12 +
                                      2 * 4 * 3 * (scene.effects.size() + aovs) + bytes_a_pixel_of_denoiser;
  check_memory(pixels * bytes_a_pixel,
               fmt::format("a picture of {}x{} pixels", window.width(), window.height()),
               "render it in pieces with --crop");
}

}  // namespace nook
