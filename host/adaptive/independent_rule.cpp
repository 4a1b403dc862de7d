#include <algorithm>
#include <cmath>

#include "adaptive/pixel_rule.hpp"

namespace nook {
namespace {

// The sums of one pixel's replicates, as numbers.
SampleSums as_numbers(const Film& film, std::uint64_t sum, std::uint64_t square, double count) {
  return {double(sum) / (double(film.sum_scale) * film.per_replicate), double(square) / film.square_scale,
          count};
}

SampleSums sums_of(const Film& film, std::size_t i) {
  return as_numbers(film, film.sum[i], film.sum_square[i], film.replicates[i]);
}

// Planes: samples and sum when the pixel stopped. Samples that it gets later for another effect do not count.
class CountedPixels : public PixelRule {
 public:
  CountedPixels(double bound, const ErrorTarget& target) : PixelRule(0, bound, target), counts_(target) {}
  std::size_t planes() const override { return 2; }

  void look(Film& film, std::uint32_t stage) override {
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (done(film, i) || film.camera_samples[i] != stage) continue;
      if (!counts_.done(stage, hits(film, film.sum[i]))) continue;
      film.kept[0][i] = stage;
      film.kept[1][i] = film.sum[i];
    }
  }
  double samples_needed(const Film& film, std::size_t i) const override {
    const double mean = sums_of(film, i).mean();
    return nook::samples_needed(mean, mean, 1, target_.error, z_);
  }
  double half_width(const Film& film, std::size_t i) const override {
    const auto [n, k] = counted(film, i);
    return counts_.half_width(n, k);
  }
  PixelEstimate estimate(const Film& film, std::size_t i) const override {
    const auto [n, k] = counted(film, i);
    return {counts_.estimate(n, k), counts_.half_width(n, k), n};
  }

 private:
  // Samples and hits when the pixel stopped, or so far.
  std::pair<std::uint32_t, std::uint32_t> counted(const Film& film, std::size_t i) const {
    if (!done(film, i)) return {film.camera_samples[i], hits(film, film.sum[i])};
    return {samples_at_stop(film, i), hits(film, film.kept[1][i])};
  }
  static std::uint32_t hits(const Film& film, std::uint64_t sum) {
    return std::uint32_t(std::lround(double(sum) / film.sum_scale));
  }
  CountRule counts_;
};

// Planes: samples, sum and sum of squares when the pixel stopped, sum and sum of squares of its pilot.
class PilotedPixels : public PixelRule {
 public:
  PilotedPixels(double bound, const ErrorTarget& target)
      : PixelRule(0, bound, target), pilot_(std::min(target.min_spp, target.max_spp)) {}
  std::size_t planes() const override { return 5; }

  void look(Film& film, std::uint32_t stage) override {
    if (stage == pilot_) {
      film.kept[3] = film.sum;
      film.kept[4] = film.sum_square;
    }
    if (planned_.empty()) plan(film);
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      if (done(film, i) || film.camera_samples[i] != stage || stage < planned_[i]) continue;
      film.kept[0][i] = stage;
      film.kept[1][i] = film.sum[i];
      film.kept[2][i] = film.sum_square[i];
    }
  }
  double samples_needed(const Film&, std::size_t i) const override {
    return planned_.empty() ? 0 : planned_[i];
  }
  PixelEstimate estimate(const Film& film, std::size_t i) const override {
    const bool stopped = done(film, i);
    const std::uint32_t n = stopped ? samples_at_stop(film, i) : film.camera_samples[i];
    SampleSums sums = stopped ? as_numbers(film, film.kept[1][i], film.kept[2][i], n) : sums_of(film, i);
    // A render that was stopped from outside within its pilot has nothing else.
    if (n > pilot_) {
      const SampleSums pilot = pilot_of(film, i);
      sums = {sums.sum - pilot.sum, sums.sum_square - pilot.sum_square, sums.count - pilot.count};
    }
    return {sums.mean(), score_interval(sums, bound_, z_).half_width(), n};
  }

 private:
  SampleSums pilot_of(const Film& film, std::size_t i) const {
    return as_numbers(film, film.kept[3][i], film.kept[4][i], pilot_);
  }

  // How many samples each pixel gets, the pilot included: 64 samples often show too little variance, hence
  // the neighbours.
  void plan(const Film& film) {
    planned_.resize(film.pixels());
    const auto needed = [&](const SampleSums& s) {
      return nook::samples_needed(s.mean(), s.sum_square / s.count, bound_, target_.error, z_);
    };
    for (int y = 0; y < film.height; ++y)
      for (int x = 0; x < film.width; ++x) {
        SampleSums around;
        for (int v = std::max(0, y - 1); v <= std::min(film.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(film.width - 1, x + 1); ++u) {
            const SampleSums s = pilot_of(film, std::size_t(v) * std::size_t(film.width) + std::size_t(u));
            around = {around.sum + s.sum, around.sum_square + s.sum_square, around.count + s.count};
          }
        const std::size_t i = std::size_t(y) * std::size_t(film.width) + std::size_t(x);
        const double n = std::max(needed(pilot_of(film, i)), needed(around));
        planned_[i] = std::uint32_t(std::min(std::ceil(n) + pilot_, double(0xffffffffu)));
      }
  }

  std::uint32_t pilot_;                 // the first stage
  std::vector<std::uint32_t> planned_;  // follows from the pilot, which is in the planes
};

}  // namespace

bool samples_are_counts(const EffectPlan& effect, std::uint32_t directions) {
  return effect.effect.kind == EffectKind::ao && effect.effect.sampling == Sampling::cosine &&
         effect.effect.falloff == Falloff::none && directions == 1;
}

std::unique_ptr<PixelRule> independent_rule(const EffectPlan& effect, const Plan& plan,
                                            const ErrorTarget& target) {
  if (samples_are_counts(effect, plan.directions))
    return std::make_unique<CountedPixels>(effect.weight_bound, target);
  return std::make_unique<PilotedPixels>(effect.weight_bound, target);
}

}  // namespace nook
