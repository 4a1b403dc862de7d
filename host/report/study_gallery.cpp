#include "report/study_gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nook {
namespace {

double rmse(const std::vector<float>& image, const StudyReference& reference) {
  double sum = 0, variance = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    sum += std::pow(double(image[i]) - double(reference.image[i]), 2);
    variance += double(reference.variance[i]);
  }
  return std::sqrt(std::max(0.0, (sum - variance) / double(image.size())));
}

// As even as the method likes its numbers of samples: whole, and a power of two for point sets.
double whole_level(const StudyMethod& method, double spp) {
  if (method.sampler == "independent") return std::clamp(std::round(spp), 1.0, 8192.0);
  return std::exp2(std::clamp(std::round(std::log2(std::max(spp, 1.0))), 0.0, 13.0));
}

struct Shown {
  GalleryPicture picture;
  double seconds = 0, error = 0;
};

Shown show(const StudyMethod& method, double level, std::uint32_t seed, const StudyReference& reference,
           const std::string& group) {
  StudyPicture made = method.render(level, seed);
  Shown shown;
  shown.seconds = made.wall_seconds;
  shown.error = rmse(made.image, reference);
  const std::string effort = method.family == StudyMethod::Family::adaptive
                                 ? fmt::format("error {:.3g} asked", level)
                             : method.family == StudyMethod::Family::ssao ? fmt::format("{} samples", level)
                                                                          : fmt::format("{} spp", level);
  shown.picture = {group, method.name,
                   fmt::format("{}, {:.2f} s, RMSE {:.4f}", effort, shown.seconds, shown.error),
                   std::move(made.image), std::move(made.samples)};
  return shown;
}

}  // namespace

std::vector<GalleryPicture> make_gallery(const StudyScene& scene, double seconds, std::uint32_t seed) {
  const bool ro = scene.effect().effect.kind == EffectKind::ro;
  const Sampling best_sampling = ro ? Sampling::lobe : Sampling::cosine;
  const StudyReference reference = scene.reference(0.5 * seconds);
  const StudyMethod best = scene.path_traced(best_sampling, Sampler::sobol, 1, 1024);
  const std::vector<StudyMethod> others = {
      scene.path_traced(ro ? Sampling::cosine : Sampling::sphere, Sampler::independent, 1, 1024),
      scene.path_traced(best_sampling, Sampler::independent, 1, 1024)};
  const StudyMethod adaptive = scene.adaptive(Sampler::sobol);

  std::vector<GalleryPicture> pictures = {
      {"reference", "reference", fmt::format("{} spp", reference.spp), reference.image, {}}};
  const Shown in_time = show(best, 32, seed, reference, "equal time"),
              to_error = show(best, 16, seed, reference, "equal error");
  std::vector<GalleryPicture> equal_time, equal_error;
  for (const StudyMethod& method : others) {
    const double seconds_a_sample = method.render(4, seed).wall_seconds / 4;
    Shown timed =
        show(method, whole_level(method, in_time.seconds / seconds_a_sample), seed, reference, "equal time");
    // Independent samples: the squared error falls as their number rises.
    const double spp = in_time.seconds / seconds_a_sample * std::pow(timed.error / to_error.error, 2);
    if (spp * seconds_a_sample < 0.3 * seconds)
      equal_error.push_back(show(method, whole_level(method, spp), seed, reference, "equal error").picture);
    equal_time.push_back(std::move(timed.picture));
  }
  Shown adapted = show(adaptive, to_error.error, seed, reference, "equal error");
  const double error_in_time =
      std::clamp(to_error.error * std::sqrt(adapted.seconds / in_time.seconds), 0.002, 0.5);
  equal_time.push_back(show(adaptive, error_in_time, seed, reference, "equal time").picture);
  equal_error.push_back(std::move(adapted.picture));
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
