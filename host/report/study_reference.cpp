// What a study measures errors against, and how much it can afford.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/stopwatch.hpp"
#include "report/study_methods.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

constexpr std::uint32_t reference_scrambles = 16;

}  // namespace

StudyReference StudyScene::reference(double seconds) const {
  const Stopwatch watch;
  const Sampling sampling = samplings_of(plan_.effects.front().effect).front();
  const Plan plan = plan_with(sampling, Sampler::halton, 1);
  OcclusionTracer tracer(device_, plan, mesh_, bvh_);
  const std::vector<std::uint32_t> order = pixels_in_order(plan.window, plan.width);
  std::vector<std::vector<Film>> scrambles;
  for (std::uint32_t r = 0; r < reference_scrambles; ++r) scrambles.push_back(tracer.make_films());
  std::uint32_t taken = 0, next = 16;
  do {
    for (std::uint32_t r = 0; r < reference_scrambles; ++r) {
      tracer.set_samples(2, reference_seed + r);
      tracer.accumulate(order, {taken, next - taken}, scrambles[r]);
    }
    taken = next;
    next *= 2;
  } while (watch.seconds() < 0.5 * seconds &&
           next <= 1u << 16);  // the next doubling takes as long as all before

  StudyReference made;
  made.spp = std::uint64_t(taken) * reference_scrambles;
  for (std::size_t i = 0; i < order.size(); ++i) {
    double sum = 0, square = 0;
    for (const auto& films : scrambles) sum += films.front().value(i);
    const double mean = sum / reference_scrambles;
    for (const auto& films : scrambles) square += std::pow(films.front().value(i) - mean, 2);
    made.image.push_back(float(mean));
    made.variance.push_back(float(square / (reference_scrambles - 1) / reference_scrambles));
  }
  made.seconds = watch.seconds();
  made.description = fmt::format("{} {}, {} scrambles of {} samples, seeds {}-{}", name_of(sampling),
                                 name_of(Sampler::halton), reference_scrambles, taken, reference_seed,
                                 reference_seed + reference_scrambles - 1);
  return made;
}

double StudyScene::samples_per_second() const {
  const Sampling sampling = samplings_of(plan_.effects.front().effect).front();
  const StudyMethod method = ray_traced(sampling, Sampler::sobol, 1, 16);
  method.render(16, 1);
  const StudyPicture picture = method.render(16, 2);
  return 16.0 * scene_.width * scene_.height / picture.wall_seconds;
}

double samples_per_pixel(const std::vector<StudyMethod>& methods) {
  double sum = 0;
  for (const StudyMethod& method : methods)
    for (const double level : method.levels) {
      const double runs = runs_wanted(method, level);
      if (method.family == StudyMethod::Family::fixed)
        sum += runs * level * std::sqrt(double(method.directions));
      if (method.family == StudyMethod::Family::adaptive)
        sum += runs * (method.sampler == "independent" ? std::max(16.0, 0.18 / (level * level))
                                                       : std::max(128.0, 0.4 * std::pow(level, -1.6)));
    }
  return sum;
}

}  // namespace nook
