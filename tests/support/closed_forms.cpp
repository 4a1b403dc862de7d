#include "support/closed_forms.hpp"

#include <cmath>
#include <numbers>

#include "support/statistics.hpp"
#include "support/warp_oracle.hpp"

namespace nook::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float unlimited = std::numeric_limits<float>::infinity();

// M from a known variance of the hemisphere's estimator, 2M - A².
double moment(double value, double hemisphere_variance) {
  return (hemisphere_variance + value * value) / 2;
}

// E[g(cosine to the normal, cosine to the axis)] over the lobe of exponent n about a mirror direction at
// theta, where the first is positive. Midpoint rule with 1 - u = t^4, which tames the lobe's edge: cos(alpha)
// = t^(4/(n+1)). Good to 3e-6 of g.
template <class G>
double lobe_mean(double n, double theta, G&& g) {
  const int angles = 1024, azimuths = 256;
  double sum = 0, total = 0;
  for (int i = 0; i < angles; ++i) {
    double t = (i + 0.5) / angles, weight = t * t * t;
    total += weight * azimuths;
    for (int j = 0; j < azimuths; ++j) {
      dvec3 w = oracle_direction(Warp::cosine_power, {1 - t * t * t * t, (j + 0.5) / azimuths}, n);
      double cosine = std::cos(theta) * w.z - std::sin(theta) * w.x;
      if (cosine > 0) sum += weight * g(cosine, w.z);
    }
  }
  return sum / total;
}

// Form factors from a differential element to a rectangle with a corner on its axis (Howell, B-4 and B-3):
// parallel at distance 1, edges a and b; and perpendicular at distance c, height a, width b.
double parallel_rectangle(double a, double b) {
  double A = std::hypot(1, a), B = std::hypot(1, b);
  return (a / A * std::atan(b / A) + b / B * std::atan(a / B)) / (2 * pi);
}
double perpendicular_rectangle(double c, double a, double b) {
  double h = std::hypot(a, c);
  return (std::atan(b / c) - c / h * std::atan(b / h)) / (2 * pi);
}

}  // namespace

double AmbientCase::variance(Sampling sampling) const {
  if (sampling == Sampling::cosine) return value - value * value;
  return (sampling == Sampling::hemisphere ? 2 : 4) * cosine_moment - value * value;
}

const std::vector<AmbientCase>& ambient_cases() {
  // The hemisphere's variances, five digits, from quadrature.
  const double overhead = 4 * parallel_rectangle(0.5, 0.5);
  static const std::vector<AmbientCase> cases{
      {"open sky", Shape::open, {}, unlimited, 1, 2.0 / 3},
      // Half of the hemisphere.
      {"infinite wall", Shape::wall, {1, unlimited, unlimited, 0}, unlimited, 0.5, 1.0 / 3},
      // By Nusselt's analogue the strip up to elevation 45 degrees takes (1 - cos 45°)/2.
      {"wall of height 1 at distance 1",
       Shape::wall,
       {1, unlimited, 1, 0},
       unlimited,
       (1 + std::sqrt(0.5)) / 2,
       moment(0.85355339, 0.48365)},
      {"wall 2 x 1 at distance 1/2",
       Shape::wall,
       {0.5f, 1, 1, 0},
       unlimited,
       1 - 2 * perpendicular_rectangle(0.5, 1, 1),
       moment(0.75146218, 0.48826)},
      // A cap of 45 degrees: sin² 45° is hidden.
      {"disk overhead", Shape::ceiling_disk, {1, 1, 0, 0}, unlimited, 0.5, moment(0.5, 0.22140)},
      // A sphere wholly above the horizon takes cos(theta) sin²(its half angle) = sqrt(1/2)/2.
      {"sphere beside",
       Shape::sphere,
       {1, 0, 1, 1},
       unlimited,
       1 - std::sqrt(0.5) / 2,
       moment(0.64644661, 0.40706)},
      {"square overhead",
       Shape::ceiling_square,
       {1, 0.5f, 0, 0},
       unlimited,
       1 - overhead,
       moment(0.76054354, 0.30676)},
      // What the square overhead hides is what an open cube lets in.
      {"cube without a lid", Shape::box, {0.5f, 1, 0, 0}, unlimited, overhead, moment(0.23945647, 0.39080)},
      // (1 - cos 60°)/2
      {"half-plane leaning over at 60 degrees", Shape::leaning_plane, {0.5f, 0, 0, 0}, unlimited, 0.25, 0},
      // On a sphere of radius R chords are 2 R cos(theta): those beyond the limit r are 1 - (r/2R)².
      {"inside a unit sphere, limit 1", Shape::sphere, {0, 0, 1, 1}, 1, 0.75, moment(0.75, 0.60417)},
      // Hits nearer than r at elevations above asin(h/r): (h/r)² stays open.
      {"infinite ceiling, limit 2",
       Shape::ceiling_disk,
       {1, unlimited, 0, 0},
       2,
       0.25,
       moment(0.25, 0.10417)},
      // A quarter of the hemisphere.
      {"corner of two infinite walls", Shape::corner, {}, unlimited, 0.25, moment(0.25, 0.27083)}};
  return cases;
}

double open_reflection(double n, double theta) {
  if (theta > pi / 2) return open_reflection(n, pi - theta) - std::cos(pi - theta);
  double c = std::cos(theta), s = std::sin(theta), m = n + 2;
  double log_w = 0.5 * std::log(pi) + std::lgamma((m + 1) / 2) - std::lgamma(m / 2 + 1);
  return c * (1 + beta_i(c * c, 0.5, n / 2 + 1)) / 2 +
         (n + 2) / (2 * pi * (n + 1)) * std::exp(log_w + m * std::log(s));
}

double open_reflection_variance(Sampling sampling, double n, double theta) {
  double mean = open_reflection(n, theta), second = 0;
  switch (sampling) {
    case Sampling::lobe:
      second = std::pow((n + 2) / (n + 1), 2) * lobe_mean(n, theta, [](double c, double) { return c * c; });
      break;
    // weight² pdf = ((n+2) cos^n / 2)² cos/pi: an RO integrand of exponent 2n.
    case Sampling::cosine:
      second = (n + 2) * (n + 2) / (4 * (n + 1)) * open_reflection(2 * n, theta);
      break;
    case Sampling::hemisphere:
    case Sampling::sphere:
      second = (sampling == Sampling::sphere ? 2 : 1) * (n + 2) * (n + 2) / (2 * n + 1) *
               lobe_mean(2 * n, theta, [](double c, double) { return c * c; });
      break;
    case Sampling::mixture: {
      double share = n * n * n / (1 + n * n * n);  // as lobe_share in kernels/effect/reflection.cl
      second = lobe_mean(n, theta, [=](double c, double alpha) {
        double lobe = std::pow(alpha, n);
        double weight = (n + 2) * lobe * c / (share * (n + 1) * lobe + 2 * (1 - share) * c);
        return (n + 2) / (n + 1) * c * weight;
      });
    }
  }
  return second - mean * mean;
}

const std::vector<ReflectionCase>& occluded_reflection_cases() {
  static const std::vector<ReflectionCase> cases = [] {
    std::vector<ReflectionCase> all;
    const glm::vec4 wall(1, unlimited, 1, 0), ball(std::sin(pi / 6) * 2, 0, std::cos(pi / 6) * 2, 0.5);
    const float exponents[] = {1, 10, 100};
    const double wall_values[] = {0.57863246963, 0.44056067031, 0.38169243533};
    for (int i = 0; i < 3; ++i) {
      all.push_back(
          {"wall across the mirror direction", Shape::wall, wall, pi / 4, exponents[i], wall_values[i]});
      // The ball hides the cap of angle beta about the mirror direction, all above the horizon: by symmetry
      // it takes cos(theta) (1 - cos^(n+2)(beta)) off, sin(beta) = 1/4.
      double n = exponents[i], theta = pi / 6,
             hidden = std::cos(theta) * (1 - std::pow(1 - 1.0 / 16, n / 2 + 1));
      all.push_back({"ball on the mirror direction", Shape::sphere, ball, theta, exponents[i],
                     open_reflection(n, theta) - hidden});
    }
    return all;
  }();
  return cases;
}

}  // namespace nook::test
