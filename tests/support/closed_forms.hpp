#pragma once

#include <limits>
#include <string>
#include <vector>

#include "math/types.hpp"
#include "scene/scene.hpp"

namespace nook::test {

/// Shapes of tests/kernels/test_estimators.cl; `size` means what its comments say.
enum class Shape { open, wall, ceiling_disk, ceiling_square, sphere, box, leaning_plane, corner };

/// AO of a receiver at the origin with normal +z, and the variance of one sample.
struct AmbientCase {
  std::string name;
  Shape shape;
  glm::vec4 size;
  float limit;
  double value;
  double cosine_moment;  ///< M = E[V cos] over the cosine distribution; 0: not known

  /// By second moments: V for the cosine weight 1, 2 V cos for the hemisphere, 4 V cos for the sphere.
  double variance(Sampling sampling) const;
};
const std::vector<AmbientCase>& ambient_cases();

/// RO of an open sky, exponent n >= 0, for a mirror direction at `theta` (0 to pi) from the normal:
///   RO = cos(theta) [1 + I_{cos²}(1/2, n/2 + 1)] / 2 + (n+2) / (2 pi (n+1)) W_{n+2} sin^{n+2}(theta),
///   W_m = sqrt(pi) Gamma((m+1)/2) / Gamma(m/2+1)
/// and below the horizon RO(pi - theta) = RO(theta) - cos(theta), since max(0,x) = (x + |x|)/2.
double open_reflection(double n, double theta);

/// Variance of one sample of an open sky, by the second moment of the weight under each distribution.
double open_reflection_variance(Sampling sampling, double n, double theta);

struct ReflectionCase {
  std::string name;
  Shape shape;
  glm::vec4 size;
  double theta;  ///< mirror direction's angle from the normal, in the half plane x > 0; radians
  float exponent;
  double value;
};
const std::vector<ReflectionCase>& occluded_reflection_cases();

}  // namespace nook::test
