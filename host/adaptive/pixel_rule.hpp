#pragma once

#include <cstdint>
#include <memory>

#include "adaptive/stop_rule.hpp"
#include "film/film.hpp"
#include "plan/plan.hpp"
#include "trace/session.hpp"

namespace nook {

/// One pixel's result.
struct PixelEstimate {
  double value = 0;
  double half_width = 0;      ///< of its interval
  std::uint32_t samples = 0;  ///< camera samples taken for it, pilot included
};

/// When one effect's pixels are accurate enough, and what their estimates are. What it must remember of a
/// pixel is in planes of Film::kept, so that a resumed render decides as an undisturbed one.
class PixelRule {
 public:
  virtual ~PixelRule() = default;
  /// Planes of Film::kept that it uses, from the first of its own on.
  virtual std::size_t planes() const { return 1; }
  /// After each stage: marks those of the pixels with `stage` camera samples that are done. A second call at
  /// the same stage changes nothing.
  virtual void look(Film& film, std::uint32_t stage) = 0;
  /// Before samples_needed() and estimate(), if the film has changed since look().
  virtual void prepare(const Film&) {}
  /// About how many camera samples a pixel that goes on will take in all.
  virtual double samples_needed(const Film& film, std::size_t pixel) const = 0;
  /// The half width of estimate(), which may cost more.
  virtual double half_width(const Film& film, std::size_t pixel) const {
    return estimate(film, pixel).half_width;
  }
  /// The half width by which the rule decides: half_width(), unless it has another.
  virtual double deciding_half_width(const Film& film, std::size_t pixel) const {
    return half_width(film, pixel);
  }
  /// The estimate of a pixel with at least one sample that is not background; it may be done or not.
  virtual PixelEstimate estimate(const Film& film, std::size_t pixel) const = 0;

  bool done(const Film& film, std::size_t pixel) const { return film.kept[plane_][pixel] != 0; }
  bool background(const Film& film, std::size_t pixel) const {
    return film.kept[plane_][pixel] & background_bit;
  }
  /// Nothing is in reach of what the pixel sees.
  bool free(const Film& film, std::size_t pixel) const { return film.kept[plane_][pixel] & free_bit; }
  /// Camera samples when it was marked; 0 while it goes on.
  std::uint32_t samples_at_stop(const Film& film, std::size_t pixel) const {
    return std::uint32_t(film.kept[plane_][pixel]);
  }
  void mark_background(Film& film, std::size_t pixel) const {
    film.kept[plane_][pixel] = background_bit | film.camera_samples[pixel];
  }
  void mark_free(Film& film, std::size_t pixel) const {
    film.kept[plane_][pixel] = free_bit | film.camera_samples[pixel];
  }

 protected:
  /// plane: of Film::kept, its first; bound: the largest sample.
  PixelRule(std::size_t plane, double bound, const ErrorTarget& target)
      : plane_(plane), bound_(bound), target_(target), z_(target.z()) {}

  static constexpr std::uint64_t background_bit = 1ull << 63, free_bit = 1ull << 62;
  std::size_t plane_;
  double bound_;
  ErrorTarget target_;
  double z_;
};

/// Whether every sample of the effect is 0 or 1: AO by the cosine distribution, one direction a camera ray,
/// and no falloff, which makes samples of all values between.
bool samples_are_counts(const EffectPlan& effect, std::uint32_t directions);

/// Samples of the pilot of effects whose independent samples are no counts.
inline constexpr std::uint32_t pilot_samples = 64;

/// CountRule, if samples are counts; otherwise a pilot of 64 camera samples decides how many more a pixel
/// gets (Stein 1945, "A two-sample test for a linear hypothesis whose power is independent of the variance"),
/// and the estimate is the mean of these alone, which the decision cannot bias. The variance behind the
/// decision is the pixel's own or that of its 3x3 neighbourhood, whichever is larger.
std::unique_ptr<PixelRule> independent_rule(const EffectPlan& effect, const Plan& plan,
                                            const ErrorTarget& target);

/// For randomised point sequences: the spread of the randomisations' means is their mean's error.
///
/// The variance of its neighbours in the 3x3 around it decides when a pixel stops. They have other random
/// numbers, so the decision biases neither the pixel's estimate nor its interval. At edges the pixel's own
/// variance may be larger: it goes on while that is more than 1.2 times the one asked for.
///
/// Few randomisations know their variance badly, so the interval's is moderated by the neighbours' too (Smyth
/// 2004, "Linear models and empirical Bayes methods", section 3): with v and v0 the two estimates of the
/// mean's variance, of d = R - 1 and d0 = 12 degrees of freedom, (d v + d0 v0) / (d + d0) has d + d0, and the
/// interval is Student's. Where nothing varies, the interval is as wide as a single deviating sample would
/// make it, which none of the nine pixels has seen.
std::unique_ptr<PixelRule> replicate_rule(const EffectPlan& effect, const Randomisations& randomisations,
                                          const ErrorTarget& target);

}  // namespace nook
