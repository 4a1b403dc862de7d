#pragma once

#include <string>
#include <vector>

#include "kernels/shared/task.h"
#include "support/closed_forms.hpp"
#include "support/kernels.hpp"

namespace nook::test {

/// How an estimate is made: the product's estimators on tests/kernels/test_estimators.cl.
struct EstimatorSetup {
  EffectKind effect = EffectKind::ao;
  Sampling sampling = Sampling::cosine;
  Sampler sampler = Sampler::independent;
};

/// What is estimated, in the receiver's axes (normal +z).
struct EstimatedScene {
  Shape shape = Shape::open;
  glm::vec4 size{0};
  float limit = std::numeric_limits<float>::infinity();
  float exponent = 0;
  vec3 view{0, 0, 1};
  float footprint = 0;
};

class Estimator {
 public:
  explicit Estimator(const EstimatorSetup& setup);
  /// From source with a defect planted (support/mutants.hpp).
  Estimator(const EstimatorSetup& setup, const std::string& source);

  /// The product's source that mutants are made of.
  static std::string source();

  /// weight * visibility of each sample, pixels x samples x directions in this order. The receiver's axes are
  /// turned by a rotation that depends on `seed`, so that no result leans on axis-aligned normals.
  std::vector<float> samples(const EstimatedScene& scene, std::uint32_t pixels, std::uint32_t samples,
                             std::uint32_t directions, std::uint32_t seed) const;

  /// The mean of each pixel: independent replicates of the estimate.
  std::vector<double> pixel_means(const EstimatedScene& scene, std::uint32_t pixels, std::uint32_t samples,
                                  std::uint32_t directions, std::uint32_t seed) const;

 private:
  TestProgram program_;
};

/// The view direction whose mirror direction is at angle theta (radians) from +z, in the half plane x > 0.
vec3 view_for_mirror_angle(double theta);

std::string name_of(Sampling sampling);
std::string name_of(Sampler sampler);

}  // namespace nook::test
