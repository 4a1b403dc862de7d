#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "film/film_part.hpp"
#include "film/image.hpp"
#include "render/path_tracer.hpp"
#include "render/stop_rule.hpp"

namespace nook {

/// One effect's picture after an adaptive render: a value per pixel of the window, row-major.
struct PixelEstimates {
  std::vector<float> value;
  std::vector<float> variance;         ///< of value: the half width of its interval over z, squared
  std::vector<std::uint32_t> samples;  ///< occlusion directions drawn, pilot included
};

struct AdaptiveProgress {
  double share_done = 0;           ///< of the pixels
  double samples_left = 0;         ///< camera samples that the rest will need, an estimate
  std::uint64_t samples_done = 0;  ///< camera samples so far
};

struct AdaptiveResult {
  std::vector<PixelEstimates> effects;
  double error_asked = 0;
  double error_reached = 0;    ///< root mean square of the standard errors of the pixels that see the mesh
  double error_worst = 0;      ///< the largest of them
  double share_done = 0;       ///< of the pixels, stopped by the rule
  bool stopped_early = false;  ///< by the progress function
  bool met() const { return share_done >= 1 && error_reached <= error_asked; }
};

/// Renders until every pixel has the error asked for, each with as many samples as it needs.
///
/// - Samples that are 0 or 1 (AO, cosine, one direction a camera ray) follow CountRule: sequential and
/// unbiased.
/// - All others take a pilot of 64 camera samples, which decides how many more the pixel gets (Stein 1945, "A
/// two-sample test..."); the
///   estimate is the mean of these alone and so has no bias from the decision. The variance is pooled with
///   the 8 neighbours'.
/// - A pixel whose first samples, and its neighbours', all miss the mesh is done at once.
///
/// Same plan, target and tracer: same bits, unless stopped by `progress`.
class AdaptiveRender {
 public:
  /// The plan a tracer needs for this: independent samples (anything else correlates the samples that the
  /// rules count), max_spp.
  static Plan plan_for(Plan plan, const ErrorTarget& target);

  /// tracer: made with `plan`, which is plan_for(...)'s; both must outlive this.
  AdaptiveRender(PathTracer& tracer, const Plan& plan, const ErrorTarget& target);
  ~AdaptiveRender();

  /// Called now and then; false stops.
  using Progress = std::function<bool(const AdaptiveProgress&)>;
  AdaptiveResult run(const Progress& progress = nullptr);

  /// The image of run()'s result. part: its layers, aovs and surface channels decide which channels there
  /// are.
  Image picture(FilmPart part, const AdaptiveResult& result) const;

 private:
  struct EffectState;
  void finish_background();
  void plan_samples(EffectState& effect);
  void mark_done(EffectState& effect, std::uint32_t stage);
  double samples_left() const;
  AdaptiveResult result() const;

  PathTracer& tracer_;
  const Plan& plan_;
  ErrorTarget target_;
  double z_;
  std::vector<std::uint32_t> order_;  // pixels, y * width + x, in launching order
  std::vector<std::size_t> place_;    // index in the films of each of order_
  std::vector<Film> films_;
  std::vector<EffectState> effects_;
  std::vector<std::uint8_t> background_;  // by film index
};

/// Whether every sample of the effect is 0 or 1.
bool samples_are_counts(const EffectPlan& effect, std::uint32_t directions);

}  // namespace nook
