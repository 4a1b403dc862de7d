#include "report/study_gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/effect_keys.hpp"

namespace nook {
namespace {

constexpr double gallery_spp = 128;

double rmse(const std::vector<float>& image, const StudyReference& reference) {
  double sum = 0, variance = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    sum += std::pow(double(image[i]) - double(reference.image[i]), 2);
    variance += double(reference.variance[i]);
  }
  return std::sqrt(std::max(0.0, (sum - variance) / double(image.size())));
}

// Rounds a number of samples as the method likes it: to a whole number, for point sets to a power of two.
double whole_level(const StudyMethod& method, double spp) {
  if (method.sampler == "independent") return std::clamp(std::round(spp), 1.0, 8192.0);
  return std::exp2(std::clamp(std::round(std::log2(std::max(spp, 1.0))), 0.0, 13.0));
}

bool is_adaptive(const StudyMethod& method) {
  return method.family == StudyMethod::Family::adaptive;
}

struct Shown {
  GalleryPicture picture;
  double level = 0, seconds = 0, error = 0;
};

Shown show(const StudyMethod& method, double level, std::uint32_t seed, const StudyReference& reference,
           const std::string& group) {
  StudyPicture made = method.render(level, seed);
  Shown shown;
  shown.level = level;
  shown.seconds = made.wall_seconds;
  shown.error = rmse(made.image, reference);
  const std::string effort = is_adaptive(method) ? fmt::format("error {:.3g} asked", level)
                             : method.family == StudyMethod::Family::ssao ? fmt::format("{} samples", level)
                                                                          : fmt::format("{} spp", level);
  shown.picture = {group, method.name,
                   fmt::format("{}, {:.2f} s, RMSE {:.4f}", effort, shown.seconds, shown.error),
                   std::move(made.image), std::move(made.samples)};
  return shown;
}

// Tries a second time where the first was off by more than a fifth: before, it is known only roughly which
// level leads to a time or an error.
Shown show_near(const StudyMethod& method, double level, std::uint32_t seed, const StudyReference& reference,
                const std::string& group, double wanted, double Shown::*measured) {
  Shown first = show(method, level, seed, reference, group);
  const double times = first.*measured / wanted;
  if (times > 1 / 1.2 && times < 1.2) return first;
  const bool of_time = measured == &Shown::seconds;
  const double next =
      !is_adaptive(method)
          ? whole_level(method, of_time ? level / times : level * times * times)
          : std::clamp(of_time ? level * std::pow(times, 1 / 1.6) : level / times, 0.001, 0.5);
  return next == level ? std::move(first) : show(method, next, seed, reference, group);
}

}  // namespace

std::vector<GalleryPicture> make_gallery(const StudyScene& scene, double seconds, std::uint32_t seed) {
  const bool ro = scene.effect().effect.kind == EffectKind::ro;
  const Sampling best_sampling = samplings_of(scene.effect().effect).front();
  const StudyReference reference = scene.reference(0.5 * seconds);
  const StudyMethod best = scene.ray_traced(best_sampling, Sampler::sobol, 1, 1024);
  const std::vector<StudyMethod> others = {
      scene.ray_traced(ro ? Sampling::cosine : Sampling::sphere, Sampler::independent, 1, 1024),
      scene.ray_traced(best_sampling, Sampler::independent, 1, 1024), scene.adaptive(Sampler::sobol)};

  std::vector<GalleryPicture> pictures = {
      {"reference", "reference", fmt::format("{} spp", reference.spp), reference.image, {}}};
  // At least as many as the least that an adaptive render takes.
  const Shown in_time = show(best, gallery_spp, seed, reference, "equal time"),
              to_error = show(best, gallery_spp, seed, reference, "equal error");
  std::vector<GalleryPicture> equal_time, equal_error;
  for (const StudyMethod& method : others) {
    const double first = is_adaptive(method) ? to_error.error : gallery_spp;
    const Shown timed =
        show_near(method, first, seed, reference, "equal time", in_time.seconds, &Shown::seconds);
    equal_time.push_back(timed.picture);
    // Independent samples: the squared error falls as their number rises.
    const double excess = std::pow(timed.error / to_error.error, 2);
    if (!is_adaptive(method) && excess * timed.seconds > 0.3 * seconds) continue;
    const double level = is_adaptive(method) ? to_error.error : whole_level(method, timed.level * excess);
    equal_error.push_back(
        show_near(method, level, seed, reference, "equal error", to_error.error, &Shown::error).picture);
  }
  equal_time.push_back(in_time.picture);
  equal_error.push_back(to_error.picture);
  for (auto* group : {&equal_time, &equal_error})
    for (GalleryPicture& picture : *group) pictures.push_back(std::move(picture));
  StudyChoice screen;
  screen.samplers = {Sampler::sobol};
  screen.samplings = {best_sampling};
  screen.max_spp = 1;
  screen.adaptive = false;
  screen.predictions = false;
  for (const StudyMethod& method : scene.methods(screen))
    if (method.family == StudyMethod::Family::ssao && method.levels.size() > 0)
      pictures.push_back(show(method, method.levels.back(), seed, reference, "screen space").picture);
  return pictures;
}

}  // namespace nook
