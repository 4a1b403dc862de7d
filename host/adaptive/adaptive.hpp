#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "adaptive/pixel_rule.hpp"
#include "film/film_part.hpp"
#include "trace/occlusion_tracer.hpp"
#include "trace/session.hpp"

namespace nook {

/// One effect's picture after an adaptive render: a value per pixel of the window, row-major.
struct PixelEstimates {
  std::vector<float> value;
  std::vector<float> variance;         ///< of value: the half width of its interval over z, squared
  std::vector<std::uint32_t> samples;  ///< occlusion directions drawn, pilot included
};

struct AdaptiveProgress {
  double share_done = 0;    ///< of the pixels
  double error = 0;         ///< root mean square of the standard errors; 0 before the first stage ended
  double samples_left = 0;  ///< camera samples that the rest will need, an estimate
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

/// The randomisations of a render to an error: 4, with 16 directions each and at least Plan::directions at
/// first, then in steps of a quarter of the power of two below; one for independent samples. plan:
/// AdaptiveRender::plan_for's.
Randomisations randomisations_of(const Plan& plan, const ErrorTarget& target);

/// Renders until every pixel has the error asked for, each with as many samples as it needs.
///
/// With independent samples: counts (AO, cosine) sequentially, all others with a pilot (independent_rule()).
/// With randomised point sequences (Sobol', Halton): by the spread of 4 randomisations (replicate_rule()).
/// That is cheaper, unless the error asked is reached by its first stage already.
///
/// A pixel is done at once if its first samples, and its neighbours', all miss the mesh. So is one whose
/// first samples, and its neighbours', all meet the mesh where nothing is in reach (AO, EffectPlan::reach):
/// its value is 1, its error 0. An occluder that only a part of the pixel has in reach, between the samples
/// of nine pixels, is missed.
///
/// Same plan, target and tracer: same bits, also of a render that was stopped and resumed.
class AdaptiveRender {
 public:
  /// The plan that a tracer needs for this. It has the point sequence that the rules work with (independent
  /// samples where they are as cheap) and the most samples. The sampler must be independent, sobol or halton.
  static Plan plan_for(Plan plan, const ErrorTarget& target);
  /// Whether a render to an error can use it.
  static bool can_use(Sampler sampler);

  /// tracer: made with `plan`, which is plan_for(...)'s; both must outlive this. identity: for the session.
  AdaptiveRender(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                 FilmPart::Texts identity = {});

  /// What a part keeps and a resumed render begins with. To resume, do it before run().
  Session& session() { return session_; }

  /// Called after each launch; false stops.
  using Progress = std::function<bool(const AdaptiveProgress&)>;
  AdaptiveResult run(const Progress& progress = nullptr);

 private:
  SampleBoxes next();
  std::size_t free_plane() const;
  bool is_one_if_free(std::size_t effect) const;
  void finish_certain();
  bool done(std::size_t pixel) const;
  void measure_progress();
  AdaptiveResult result();

  const Plan& plan_;
  ErrorTarget target_;
  Randomisations randomisations_;
  std::vector<std::unique_ptr<PixelRule>> rules_;  // by effect
  std::vector<std::uint32_t> stages_;              // camera samples of a pixel after each stage
  Session session_;
  AdaptiveProgress now_;
};

}  // namespace nook
