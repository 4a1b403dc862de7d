#include "render/adaptive.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture.hpp"

namespace nook {
namespace {

constexpr std::uint32_t pilot_samples = 64;
constexpr std::uint32_t never = 0xffffffffu;

// The sums of one pixel's replicates, as numbers.
SampleSums sums_of(const Film& film, std::size_t i) {
  const double scale = double(film.sum_scale) * film.per_replicate;
  return {double(film.sum[i]) / scale, double(film.sum_square[i]) / film.square_scale,
          double(film.replicates[i])};
}

SampleSums operator-(const SampleSums& a, const SampleSums& b) {
  return {a.sum - b.sum, a.sum_square - b.sum_square, a.count - b.count};
}

}  // namespace

// What is known of one effect.
struct AdaptiveRender::EffectState {
  double bound = 1;                    // the largest sample
  std::optional<CountRule> counts;     // samples are 0 or 1
  std::vector<SampleSums> pilot;       // otherwise: by film index
  std::vector<std::uint32_t> planned;  // otherwise: camera samples to take, pilot included
  // The sums when the pixel stopped: further samples for another effect's sake do not count.
  std::vector<SampleSums> stopped;
  std::vector<std::uint32_t> samples_at_stop;  // camera samples, `never` while going on
};

bool samples_are_counts(const EffectPlan& effect, std::uint32_t directions) {
  return effect.effect.kind == EffectKind::ao && effect.effect.sampling == Sampling::cosine &&
         effect.effect.falloff == Falloff::none && directions == 1;
}

Plan AdaptiveRender::plan_for(Plan plan, const ErrorTarget& target) {
  plan.sampler = Sampler::independent;
  plan.spp = std::max(2u, target.max_spp);
  plan.replicate_directions = false;
  return plan;
}

AdaptiveRender::AdaptiveRender(PathTracer& tracer, const Plan& plan, const ErrorTarget& target)
    : tracer_(tracer),
      plan_(plan),
      target_(target),
      z_(target.z()),
      order_(pixels_in_order(plan.window, plan.width)),
      films_(tracer.make_films()) {
  for (const std::uint32_t pixel : order_) place_.push_back(plan_.film_index(pixel));
  const bool all_counts =
      std::all_of(plan_.effects.begin(), plan_.effects.end(),
                  [&](const EffectPlan& effect) { return samples_are_counts(effect, plan_.directions); });
  if (!all_counts) target_.min_spp = std::max(target_.min_spp, pilot_samples);
  for (const EffectPlan& effect : plan_.effects) {
    EffectState& state = effects_.emplace_back();
    state.bound = effect.weight_bound;
    if (samples_are_counts(effect, plan_.directions)) state.counts.emplace(target_);
    state.stopped.resize(order_.size());
    state.samples_at_stop.assign(order_.size(), never);
  }
  background_.resize(order_.size());
}

AdaptiveRender::~AdaptiveRender() = default;

// Pixels without a hit so far, surrounded by such.
void AdaptiveRender::finish_background() {
  const int width = plan_.window.width(), height = plan_.window.height();
  const auto empty = [&](int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height ||
           films_.front().hits[std::size_t(y) * std::size_t(width) + std::size_t(x)] == 0;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      bool all = true;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) all = all && empty(x + dx, y + dy);
      if (!all) continue;
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      background_[i] = 1;
      for (EffectState& effect : effects_) effect.samples_at_stop[i] = films_.front().camera_samples[i];
    }
}

// After the pilot: how many samples each pixel gets. The variance is the pixel's own or the mean over its 3x3
// neighbourhood, whichever is larger: 64 samples often show too little of it.
void AdaptiveRender::plan_samples(EffectState& effect) {
  const Film& film = films_[std::size_t(&effect - effects_.data())];
  const int width = plan_.window.width(), height = plan_.window.height();
  effect.pilot.resize(film.pixels());
  effect.planned.resize(film.pixels());
  for (std::size_t i = 0; i < film.pixels(); ++i) effect.pilot[i] = sums_of(film, i);
  const auto needed = [&](const SampleSums& s) {
    return samples_needed(s.mean(), s.sum_square / s.count, effect.bound, target_.error, z_);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      SampleSums around;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
          const SampleSums& s = effect.pilot[std::size_t(v) * std::size_t(width) + std::size_t(u)];
          around = {around.sum + s.sum, around.sum_square + s.sum_square, around.count + s.count};
        }
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      const double n = std::max(needed(effect.pilot[i]), needed(around));
      effect.planned[i] = std::uint32_t(std::min(std::ceil(n) + target_.min_spp, double(never - 1)));
    }
}

void AdaptiveRender::mark_done(EffectState& effect, std::uint32_t stage) {
  const Film& film = films_[std::size_t(&effect - effects_.data())];
  for (std::size_t i = 0; i < film.pixels(); ++i) {
    if (effect.samples_at_stop[i] != never || film.camera_samples[i] < stage) continue;
    const SampleSums sums = sums_of(film, i);
    const bool done = effect.counts ? effect.counts->done(stage, std::uint32_t(std::lround(sums.sum)))
                                    : stage >= effect.planned[i];
    if (!done) continue;
    effect.samples_at_stop[i] = stage;
    effect.stopped[i] = sums;
  }
}

double AdaptiveRender::samples_left() const {
  double left = 0;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    double most = 0;
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      const EffectState& effect = effects_[e];
      if (effect.samples_at_stop[i] != never) continue;
      const SampleSums s = sums_of(films_[e], i);
      const double total = effect.counts ? samples_needed(s.mean(), s.mean(), 1, target_.error, z_)
                                         : double(effect.planned[i]);
      most = std::max(most, std::min(total, double(target_.max_spp)) - s.count);
    }
    left += most;
  }
  return left;
}

AdaptiveResult AdaptiveRender::run(const Progress& progress) {
  AdaptiveProgress now;
  bool stop = false;
  std::uint32_t taken = 0;
  std::vector<std::uint32_t> active = order_;
  for (const std::uint32_t stage : checkpoints(target_.min_spp, target_.max_spp)) {
    const std::uint64_t before = now.samples_done;
    const double left_before = now.samples_left;
    std::uint64_t samples = 0;
    const bool complete =
        tracer_.accumulate(active, {taken, stage - taken}, films_, [&](std::span<const Finished> finished) {
          for (const Finished& part : finished) samples += (part.end - part.begin) * part.range.count;
          now.samples_done = before + samples;
          now.samples_left = std::max(0.0, left_before - double(samples));
          return !(stop = stop || (progress && !progress(now)));
        });
    stop = stop || !complete;
    if (stop && taken == 0) break;  // no pixel has what a decision needs
    if (taken == 0) {
      finish_background();
      for (EffectState& effect : effects_)
        if (!effect.counts) plan_samples(effect);
    }
    taken = stage;
    for (EffectState& effect : effects_) mark_done(effect, stage);
    active.clear();
    for (std::size_t p = 0; p < order_.size(); ++p)
      if (std::any_of(effects_.begin(), effects_.end(),
                      [&](const EffectState& e) { return e.samples_at_stop[place_[p]] == never; }))
        active.push_back(order_[p]);
    now.share_done = 1 - double(active.size()) / double(order_.size());
    now.samples_left = samples_left();
    if (stop || active.empty() || (progress && !progress(now))) {
      stop = stop || !active.empty();
      break;
    }
  }
  AdaptiveResult made = result();
  made.stopped_early = stop;
  return made;
}

AdaptiveResult AdaptiveRender::result() const {
  AdaptiveResult made;
  made.error_asked = target_.error;
  double square = 0, covered = 0;
  std::size_t open = 0;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const EffectState& effect = effects_[e];
    const Film& film = films_[e];
    PixelEstimates& out = made.effects.emplace_back();
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      const bool done = effect.samples_at_stop[i] != never;
      open += !done;
      const std::uint32_t n = done ? effect.samples_at_stop[i] : film.camera_samples[i];
      SampleSums sums = done ? effect.stopped[i] : sums_of(film, i);
      if (!effect.pilot.empty() && !background_[i] && sums.count > effect.pilot[i].count)
        sums = sums - effect.pilot[i];
      const double half = background_[i] ? 0 : score_interval(sums, effect.bound, z_).half_width();
      const double value = background_[i]  ? 0
                           : effect.counts ? effect.counts->estimate(n, std::uint32_t(std::lround(sums.sum)))
                                           : sums.mean();
      const double variance = (half / z_) * (half / z_);
      out.value.push_back(float(value));
      out.variance.push_back(float(variance));
      out.samples.push_back(n * plan_.directions);
      if (background_[i]) continue;
      square += variance;
      covered += 1;
      made.error_worst = std::max(made.error_worst, std::sqrt(variance));
    }
  }
  made.error_reached = covered > 0 ? std::sqrt(square / covered) : 0;
  made.share_done = 1 - double(open) / double(std::max<std::size_t>(1, effects_.size() * order_.size()));
  return made;
}

Image AdaptiveRender::picture(FilmPart part, const AdaptiveResult& result) const {
  part.films = films_;
  Image image = make_picture(part);
  for (std::size_t e = 0; e < result.effects.size(); ++e) {
    const std::string& layer = part.layers[e];
    const std::string of_effect = layer.empty() ? "AO." : layer;
    for (Channel& channel : image.channels) {
      if (channel.name == layer + "R" || channel.name == layer + "G" || channel.name == layer + "B")
        channel.values = result.effects[e].value;
      if (channel.name == of_effect + "variance") channel.values = result.effects[e].variance;
      if (channel.name == of_effect + "samples") channel.values = result.effects[e].samples;
    }
  }
  return image;
}

}  // namespace nook
