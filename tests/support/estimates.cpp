#include "support/estimates.hpp"

#include <cmath>
#include <random>

namespace nook::test {
namespace {

BuildOptions options_for(const EstimatorSetup& setup) {
  BuildOptions options;
  options.define("EFFECT", setup.effect == EffectKind::ro)
      .define("SAMPLING", long(setup.sampling))
      .define("SAMPLER", long(setup.sampler));
  return options;
}

// A random right-handed orthonormal basis: x, y and z in world coordinates.
std::vector<float> random_axes(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  dvec3 z = glm::normalize(dvec3(gauss(random), gauss(random), gauss(random)));
  dvec3 x = glm::normalize(glm::cross(dvec3(gauss(random), gauss(random), gauss(random)), z));
  dvec3 y = glm::cross(z, x);
  return {float(x.x), float(x.y), float(x.z), float(y.x), float(y.y),
          float(y.z), float(z.x), float(z.y), float(z.z)};
}

}  // namespace

Estimator::Estimator(const EstimatorSetup& setup) : Estimator(setup, source()) {}
Estimator::Estimator(const EstimatorSetup& setup, const std::string& source)
    : program_(source, options_for(setup)) {}

std::string Estimator::source() {
  return test_kernel_source("test_estimators.cl");
}

std::vector<float> Estimator::samples(const EstimatedScene& scene, std::uint32_t pixels,
                                      std::uint32_t samples, std::uint32_t directions,
                                      std::uint32_t seed) const {
  EstimatorParams p{};
  p.samples = p.total_samples = samples;
  p.directions = p.total_directions = directions;
  p.seed = seed;
  p.width = 256;
  p.max_distance = scene.limit;
  p.exponent = scene.exponent;
  std::vector<float> view{scene.view.x, scene.view.y, scene.view.z},
      values(std::size_t(pixels) * samples * directions);
  program_.run("estimate", values.size(), p, random_axes(seed), view, cl_uint(scene.shape), scene.size,
               scene.footprint, InOut<float>{values});
  return values;
}

std::vector<double> Estimator::pixel_means(const EstimatedScene& scene, std::uint32_t pixels,
                                           std::uint32_t samples_per_pixel, std::uint32_t directions,
                                           std::uint32_t seed) const {
  std::vector<float> values = samples(scene, pixels, samples_per_pixel, directions, seed);
  std::size_t per_pixel = std::size_t(samples_per_pixel) * directions;
  std::vector<double> means(pixels);
  for (std::size_t i = 0; i < values.size(); ++i)
    means[i / per_pixel] += double(values[i]) / double(per_pixel);
  return means;
}

vec3 view_for_mirror_angle(double theta) {
  return vec3(float(-std::sin(theta)), 0.0f, float(std::cos(theta)));
}

std::string name_of(Sampling sampling) {
  const char* names[] = {"cosine", "hemisphere", "sphere", "lobe", "mixture"};
  return names[int(sampling)];
}

std::string name_of(Sampler sampler) {
  const char* names[] = {"independent", "stratified", "halton", "sobol", "zorder"};
  return names[int(sampler)];
}

}  // namespace nook::test
