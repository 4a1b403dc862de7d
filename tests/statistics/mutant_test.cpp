// Planted defects: each must be rejected by the closed forms, at a level the correct code never comes near.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/estimates.hpp"
#include "support/mutants.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

constexpr double pi = std::numbers::pi;

struct Mutant {
  std::string name;
  EstimatorSetup setup;
  EstimatedScene scene;
  double expected;
  std::string find, replace;
};

EstimatedScene grazing(float exponent) {
  EstimatedScene scene;
  scene.exponent = exponent;
  scene.view = view_for_mirror_angle(75 * pi / 180);
  return scene;
}

std::vector<Mutant> mutants() {
  const EstimatorSetup cosine{EffectKind::ao, Sampling::cosine},
      hemisphere{EffectKind::ao, Sampling::hemisphere}, sphere{EffectKind::ao, Sampling::sphere},
      lobe{EffectKind::ro, Sampling::lobe}, mixture{EffectKind::ro, Sampling::mixture},
      lobe_by_cosine{EffectKind::ro, Sampling::cosine};
  const EstimatedScene open, wall{Shape::wall, {1, INFINITY, 1, 0}};
  const double wall_value = (1 + std::sqrt(0.5)) / 2, ten = open_reflection(10, 75 * pi / 180);
  return {{"lobe sampled with n + 2", lobe, grazing(1), open_reflection(1, 75 * pi / 180),
           "log_one_minus_square(r) / (exponent + 1.0f)", "log_one_minus_square(r) / (exponent + 2.0f)"},
          {"lobe's normalisation n + 1 for n + 2", lobe_by_cosine, grazing(10), ten,
           "0.5f * (exponent + 2.0f) * lobe", "0.5f * (exponent + 1.0f) * lobe"},
          {"weight (n+1)/(n+2)", lobe, grazing(10), ten, "(exponent + 2.0f) / (exponent + 1.0f) * cosine",
           "(exponent + 1.0f) / (exponent + 2.0f) * cosine"},
          {"no foreshortening", lobe, grazing(10), ten, "(exponent + 2.0f) / (exponent + 1.0f) * cosine",
           "(exponent + 2.0f) / (exponent + 1.0f)"},
          {"|cos| for max(0, cos) in RO", lobe, grazing(10), ten, "float cosine = cosine_between(normal, w);",
           "float cosine = fabs(cosine_between(normal, w));"},
          {"|cos| for max(0, cos) in AO", sphere, open, 1, "4.0f * fmax(0.0f, in_frame.z)",
           "4.0f * fabs(in_frame.z)"},
          {"hemisphere drawn, weighted as cosine", cosine, wall, wall_value,
           "in_frame = square_to_cosine_hemisphere(u);\n    weight",
           "in_frame = square_to_hemisphere(u);\n    weight"},
          {"hemisphere drawn, weighted as sphere", sphere, open, 1, "4.0f * fmax(0.0f, in_frame.z)",
           "2.0f * fmax(0.0f, in_frame.z)"},
          {"sphere drawn for the hemisphere", hemisphere, wall, wall_value,
           "in_frame = square_to_hemisphere(u);\n    weight", "in_frame = square_to_sphere(u);\n    weight"},
          {"flipped normal", cosine, wall, wall_value, "*direction = to_world(&frame, in_frame);",
           "*direction = -to_world(&frame, in_frame);"},
          {"shared u and v", cosine, wall, wall_value, "uy[k] = uint_to_unit_float(h.y);", "uy[k] = ux[k];"},
          {"lobe about the view, not its mirror",
           lobe,
           {Shape::wall, {1, INFINITY, 1, 0}, INFINITY, 10, view_for_mirror_angle(pi / 4)},
           0.44056067031,
           "mirror_direction(normal, view)",
           "view"},
          {"mixture without the balance heuristic", mixture, grazing(2), open_reflection(2, 75 * pi / 180),
           "share * (exponent + 1.0f) * lobe + 2.0f * (1.0f - share) * cosine",
           "from_lobe ? (exponent + 1.0f) * lobe : cosine"},
          {"mixture that reuses u without stretching it",
           mixture,
           {Shape::wall, {1, INFINITY, 1, 0}, INFINITY, 1, view_for_mirror_angle(pi / 4)},
           0.57863246963,
           "from_lobe ? u.x / share : (u.x - share) / (1.0f - share)",
           "u.x"}};
}

double z_score(const Estimator& estimator, const EstimatedScene& scene, double expected) {
  std::vector<float> values = estimator.samples(scene, 1024, 1, 256, 21);
  Moments m = moments(std::span<const float>(values));
  return welch_z(m.mean, m.mean_error, expected, 0);
}

TEST(Mutants, OfTheEstimatorsAreRejectedByClosedForms) {
  for (const Mutant& m : mutants()) {
    Estimator mutant(m.setup, mutate(Estimator::source(), m.find, m.replace));
    EXPECT_GT(std::abs(z_score(mutant, m.scene, m.expected)), 6) << m.name << " survived";
    EXPECT_LT(std::abs(z_score(Estimator(m.setup), m.scene, m.expected)), 3.5)
        << m.name << ": the correct code fails";
  }
}

}  // namespace
}  // namespace nook::test
