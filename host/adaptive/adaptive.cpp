#include "adaptive/adaptive.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nook {
namespace {

constexpr std::uint32_t randomisations = 4;
// Directions of each randomisation before a pixel may stop.
constexpr std::uint32_t first_directions = 16;
// Counts need at most 1/4 error^-2 samples; four randomisations need at least 64, a net of 16 each, and take
// more in steps of a quarter.
constexpr double counts_from_error = 0.03;

bool all_counts(const Plan& plan) {
  return std::all_of(plan.effects.begin(), plan.effects.end(),
                     [&](const EffectPlan& effect) { return samples_are_counts(effect, plan.directions); });
}

ErrorTarget target_with_pilot(const Plan& plan, ErrorTarget target) {
  if (plan.sampler == Sampler::independent && !all_counts(plan))
    target.min_spp = std::max(target.min_spp, pilot_samples);
  return target;
}

std::vector<std::unique_ptr<PixelRule>> rules_of(const Plan& plan, const ErrorTarget& target,
                                                 const Randomisations& sequence) {
  std::vector<std::unique_ptr<PixelRule>> rules;
  for (const EffectPlan& effect : plan.effects)
    rules.push_back(sequence.count > 1 ? replicate_rule(effect, sequence, target)
                                       : independent_rule(effect, plan, target));
  return rules;
}

std::size_t most_planes(const std::vector<std::unique_ptr<PixelRule>>& rules) {
  std::size_t planes = 0;
  for (const auto& rule : rules) planes = std::max(planes, rule->planes());
  return planes;
}

}  // namespace

Randomisations randomisations_of(const Plan& plan, const ErrorTarget& target) {
  if (plan.sampler == Sampler::independent) return {};
  Randomisations made{randomisations, {}};
  const std::uint32_t most = std::max(1u, target.max_spp / randomisations),
                      least =
                          (std::min(target.min_spp, target.max_spp) + randomisations - 1) / randomisations;
  const std::uint32_t first = (first_directions + plan.directions - 1) / plan.directions;
  for (std::uint32_t n = first; n < most; n += std::max(1u, std::bit_floor(n) / 4))
    if (n >= least) made.stages.push_back(n);
  made.stages.push_back(most);
  return made;
}

bool AdaptiveRender::can_use(Sampler sampler) {
  return sampler == Sampler::independent || sampler == Sampler::sobol || sampler == Sampler::halton;
}

Plan AdaptiveRender::plan_for(Plan plan, const ErrorTarget& target) {
  plan.replicate_directions = false;
  if (all_counts(plan) && !plan.choose_directions && target.error >= counts_from_error)
    plan.sampler = Sampler::independent;
  plan.spp = std::max(2u, target.max_spp);
  if (plan.sampler != Sampler::independent)
    plan.spp = std::max(2u, randomisations * randomisations_of(plan, target).stages.back());
  return plan;
}

AdaptiveRender::AdaptiveRender(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                               FilmPart::Texts identity)
    : plan_(plan),
      target_(target_with_pilot(plan, target)),
      randomisations_(randomisations_of(plan, target_)),
      rules_(rules_of(plan, target_, randomisations_)),
      session_(tracer, plan, std::move(identity), randomisations_, most_planes(rules_) + 1) {
  tracer.count_free(free_plane());
  if (randomisations_.count == 1)
    stages_ = stages_from(target_.min_spp, target_.max_spp);
  else
    for (const std::uint32_t n : randomisations_.stages) stages_.push_back(n * randomisations_.count);
}

std::size_t AdaptiveRender::free_plane() const {
  return session_.films().front().kept.size() - 1;
}

// Whether effect e's value is 1 wherever nothing is in reach. (With bent normals that holds for the AO, but
// not for the direction.)
bool AdaptiveRender::is_one_if_free(std::size_t e) const {
  return plan_.effects[e].reach && plan_.effects[e].effect.kind == EffectKind::ao;
}

// Marks pixels without a hit so far, and pixels whose samples all hit the mesh and have nothing in reach, if
// their neighbours are such too.
void AdaptiveRender::finish_certain() {
  for (std::size_t e = 0; e < rules_.size(); ++e) {
    Film& film = session_.films()[e];
    const auto index = [&](int x, int y) {
      return std::size_t(y) * std::size_t(film.width) + std::size_t(x);
    };
    const auto empty = [&](std::size_t i) { return film.hits[i] == 0; };
    const auto free = [&](std::size_t i) {
      const std::uint32_t n = film.camera_samples[i];
      return is_one_if_free(e) && film.hits[i] == n && film.kept[free_plane()][i] == n;
    };
    const auto certain = [&](int x, int y) {
      return x < 0 || y < 0 || x >= film.width || y >= film.height || empty(index(x, y)) || free(index(x, y));
    };
    for (int y = 0; y < film.height; ++y)
      for (int x = 0; x < film.width; ++x) {
        bool all = true;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) all = all && certain(x + dx, y + dy);
        if (!all) continue;
        if (empty(index(x, y)))
          rules_[e]->mark_background(film, index(x, y));
        else
          rules_[e]->mark_free(film, index(x, y));
      }
  }
}

bool AdaptiveRender::done(std::size_t pixel) const {
  for (std::size_t e = 0; e < rules_.size(); ++e)
    if (!rules_[e]->done(session_.films()[e], pixel)) return false;
  return true;
}

// The schedule. It depends on nothing but films and constants, so that a resumed render has the same.
SampleBoxes AdaptiveRender::next() {
  std::vector<Film>& films = session_.films();
  const auto& taken_by = films.front().camera_samples;
  const std::uint32_t taken = *std::max_element(taken_by.begin(), taken_by.end());
  if (taken > 0) {
    if (taken == stages_.front()) finish_certain();
    for (std::size_t e = 0; e < rules_.size(); ++e) rules_[e]->look(films[e], taken);
    measure_progress();
  }
  const auto stage = std::upper_bound(stages_.begin(), stages_.end(), taken);
  if (stage == stages_.end()) return {};
  SampleBoxes boxes;
  for (std::uint32_t p = 0; p < session_.order().size(); ++p) {
    if (done(session_.film_index(p))) continue;
    if (!boxes.empty() && boxes.back().pixel_end == p)
      ++boxes.back().pixel_end;
    else
      boxes.push_back({p, p + 1, taken, *stage});
  }
  return boxes;
}

void AdaptiveRender::measure_progress() {
  const double z = target_.z();
  const std::vector<Film>& films = session_.films();
  double square = 0, seen = 0;
  std::size_t open = 0;
  now_.samples_left = 0;
  for (std::size_t i = 0; i < films.front().pixels(); ++i) {
    open += !done(i);
    double most = 0;
    for (std::size_t e = 0; e < rules_.size(); ++e) {
      if (rules_[e]->background(films[e], i)) continue;
      seen += 1;
      if (rules_[e]->free(films[e], i)) continue;
      const double error = rules_[e]->half_width(films[e], i) / z;
      square += error * error;
      if (!rules_[e]->done(films[e], i))
        most = std::max(most, std::min(rules_[e]->samples_needed(films[e], i), double(stages_.back())) -
                                  films[e].camera_samples[i]);
    }
    now_.samples_left += most;
  }
  now_.share_done = 1 - double(open) / double(films.front().pixels());
  now_.error = seen > 0 ? std::sqrt(square / seen) : 0;
}

AdaptiveResult AdaptiveRender::run(const Progress& progress) {
  std::uint64_t at_stage = session_.samples_held();
  double left_at_stage = 0;
  const bool finished = session_.run(
      [&](const Session& session) {
        SampleBoxes boxes = next();
        at_stage = session.samples_held();
        left_at_stage = now_.samples_left;
        return boxes;
      },
      [&] {
        now_.samples_done = session_.samples_held();
        now_.samples_left = std::max(0.0, left_at_stage - double(now_.samples_done - at_stage));
        return !progress || progress(now_);
      });
  AdaptiveResult made = result();
  made.stopped_early = !finished;
  return made;
}

AdaptiveResult AdaptiveRender::result() {
  const double z = target_.z();
  AdaptiveResult made;
  made.error_asked = target_.error;
  double square = 0, seen = 0;
  std::size_t open = 0;
  for (std::size_t e = 0; e < rules_.size(); ++e) {
    PixelRule& rule = *rules_[e];
    const Film& film = session_.films()[e];
    rule.prepare(film);
    PixelEstimates& out = made.effects.emplace_back();
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      open += !rule.done(film, i);
      PixelEstimate pixel;
      if (rule.background(film, i))
        pixel.samples = film.camera_samples[i];
      else if (rule.free(film, i))
        pixel = {1, 0, rule.samples_at_stop(film, i)};
      else if (film.camera_samples[i] > 0)
        pixel = rule.estimate(film, i);
      else
        pixel.half_width = 0.5;  // nothing is known
      const double error = pixel.half_width / z;
      out.value.push_back(float(pixel.value));
      out.variance.push_back(float(error * error));
      out.samples.push_back(pixel.samples * plan_.directions);
      if (rule.background(film, i)) continue;
      square += error * error;
      seen += 1;
      made.error_worst = std::max(made.error_worst, error);
    }
  }
  made.error_reached = seen > 0 ? std::sqrt(square / seen) : 0;
  made.share_done =
      1 - double(open) / double(std::max<std::size_t>(1, rules_.size() * session_.order().size()));
  return made;
}

}  // namespace nook
