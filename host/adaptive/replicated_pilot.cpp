#include "adaptive/replicated_pilot.hpp"

#include <algorithm>
#include <cmath>

namespace nook {

ReplicatedPilot::ReplicatedPilot(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                                 std::vector<std::uint32_t> positions)
    : target_(target),
      randomisations_(randomisations_of(plan, target)),
      session_(tracer, plan, {}, randomisations_, 1),
      positions_(std::move(positions)) {
  for (const EffectPlan& effect : plan.effects)
    rules_.push_back(replicate_rule(effect, randomisations_, target));
  for (const std::uint32_t n : randomisations_.stages) stages_.push_back(n * randomisations_.count);
}

double ReplicatedPilot::run(const std::function<bool()>& go_on, const Deadline::Clock& clock) {
  constexpr std::size_t least_stages = 3;
  std::size_t stage = 0;
  double began = clock(), samples = 0;
  struct Pace {
    double samples, seconds;
  };
  std::vector<Pace> paces;
  // Background takes the first stage's samples and no more. (If all is background, the rate is that of
  // these.)
  const auto goes_on = [&](std::uint32_t p) {
    return stage == 0 || background_only_ || session_.films().front().hits[session_.film_index(p)] > 0;
  };
  const Session::Schedule next = [&](const Session&) -> SampleBoxes {
    if (stage > 0) remember();
    if (stage > 1 || stage == stages_.size()) paces.push_back({samples, std::max(clock() - began, 1e-9)});
    if (stage == 1) background_only_ = std::none_of(positions_.begin(), positions_.end(), goes_on);
    if (stage == stages_.size() || (stage >= least_stages && !go_on())) return {};
    began = clock();
    const std::uint32_t taken = stage > 0 ? stages_[stage - 1] : 0;
    SampleBoxes boxes;
    samples = 0;
    for (const std::uint32_t p : positions_) {
      if (!goes_on(p)) continue;
      samples += stages_[stage] - taken;
      if (!boxes.empty() && boxes.back().pixel_end == p)
        ++boxes.back().pixel_end;
      else
        boxes.push_back({p, p + 1, taken, stages_[stage]});
    }
    ++stage;
    return boxes;
  };
  session_.run(next, [] { return true; });
  // The last stages are the largest, like those on which a long render spends its time. Small ones leave
  // threads idle.
  Pace pace{0, 0};
  for (std::size_t last = paces.size() > 3 ? paces.size() - 3 : 0; last < paces.size(); ++last)
    pace = {pace.samples + paces[last].samples, pace.seconds + paces[last].seconds};
  return pace.samples / pace.seconds;
}

void ReplicatedPilot::remember() {
  std::vector<double>& now = half_widths_.emplace_back(positions_.size());
  for (std::size_t e = 0; e < rules_.size(); ++e) {
    const Film& film = session_.films()[e];
    rules_[e]->prepare(film);
    for (std::size_t p = 0; p < positions_.size(); ++p) {
      const std::size_t i = session_.film_index(positions_[p]);
      if (film.hits[i] > 0) now[p] = std::max(now[p], rules_[e]->deciding_half_width(film, i));
    }
  }
}

// The pixels' variance falls like n^-rate.
double ReplicatedPilot::rate() const {
  const std::size_t last = half_widths_.size() - 1;
  std::size_t base = 0;  // the last with at most a quarter of the samples
  while (base + 1 < last && 4 * stages_[base + 1] <= stages_[last]) ++base;
  const auto mean_square = [&](std::size_t stage) {
    double sum = 0;
    for (const double half : half_widths_[stage]) sum += half * half;
    return sum;
  };
  if (base == last || !(mean_square(last) > 0)) return 1;
  const double rate =
      std::log(mean_square(base) / mean_square(last)) / std::log(double(stages_[last]) / stages_[base]);
  return std::clamp(rate, 1.0, 2.0);
}

double ReplicatedPilot::samples_for(double error) const {
  const double wanted = target_.z() * error;
  const double slope = rate();
  double total = 0;
  for (std::size_t p = 0; p < positions_.size(); ++p) {
    std::size_t stage = 0;
    while (stage < half_widths_.size() && half_widths_[stage][p] > wanted) ++stage;
    if (stage == half_widths_.size()) {
      const double n = stages_[stage - 1] * std::pow(half_widths_.back()[p] / wanted, 2 / slope);
      stage = std::min(std::size_t(std::lower_bound(stages_.begin(), stages_.end(), n) - stages_.begin()),
                       stages_.size() - 1);
    }
    total += stages_[stage];
  }
  return total / double(positions_.size());
}

double ReplicatedPilot::samples_as_counts(double error) const {
  const Film& film = session_.films().front();
  double total = 0;
  for (const std::uint32_t p : positions_) {
    const std::size_t i = session_.film_index(p);
    const double value = film.hits[i] > 0 ? std::min(1.0, film.value(i)) : 0;
    const double n = film.hits[i] > 0 ? samples_needed(value, value, 1, error, target_.z()) : 0;
    total += std::clamp(n, double(target_.min_spp), double(target_.max_spp));
  }
  return total / double(positions_.size());
}

}  // namespace nook
