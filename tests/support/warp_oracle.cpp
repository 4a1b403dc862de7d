#include "support/warp_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook::test {
namespace {

constexpr double pi = std::numbers::pi;

// log cos(theta); from the sine where the cosine is near 1, since the argument was rounded to float.
double log_cosine(const dvec3& w) {
  double s2 = w.x * w.x + w.y * w.y;
  return s2 < 0.5 ? 0.5 * std::log1p(-s2) : std::log(w.z);
}

// 1 - cos(theta), without cancellation at the pole.
double one_minus_cosine(const dvec3& w) {
  return w.z > 0 ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z;
}

}  // namespace

double oracle_pdf(Warp warp, const dvec3& w, double exponent) {
  switch (warp) {
    case Warp::disk:
      return 1 / pi;
    case Warp::sphere:
      return 1 / (4 * pi);
    case Warp::hemisphere:
      return w.z > 0 ? 1 / (2 * pi) : 0;
    case Warp::cosine_hemisphere:
      return std::max(0.0, w.z) / pi;
    case Warp::cosine_power:
      return w.z > 0 ? (exponent + 1) / (2 * pi) * std::exp(exponent * log_cosine(w)) : 0;
  }
  return 0;
}

glm::dvec2 oracle_cdf(Warp warp, const dvec3& w, double exponent) {
  double phi = std::atan2(w.y, w.x) / (2 * pi);
  if (phi < 0) phi += 1;
  double p = 0;
  switch (warp) {
    case Warp::disk:
      p = w.x * w.x + w.y * w.y;
      break;
    case Warp::sphere:
      p = one_minus_cosine(w) / 2;
      break;
    case Warp::hemisphere:
      p = one_minus_cosine(w);
      break;
    case Warp::cosine_hemisphere:
      p = w.x * w.x + w.y * w.y;
      break;
    case Warp::cosine_power:
      p = -std::expm1((exponent + 1) * log_cosine(w));
      break;
  }
  return {p, phi};
}

dvec3 oracle_direction(Warp warp, const glm::dvec2& u, double exponent) {
  double cosine = 0, sine = std::sqrt(u.x);  // disk: the radius
  switch (warp) {
    case Warp::disk:
      break;
    case Warp::sphere:
      cosine = 1 - 2 * u.x;
      sine = 2 * std::sqrt(u.x * (1 - u.x));
      break;
    case Warp::hemisphere:
      cosine = 1 - u.x;
      sine = std::sqrt(u.x * (2 - u.x));
      break;
    case Warp::cosine_hemisphere:
      cosine = std::sqrt(1 - u.x);
      break;
    case Warp::cosine_power: {
      double log_cos = std::log1p(-u.x) / (exponent + 1);
      cosine = std::exp(log_cos);
      sine = std::sqrt(-std::expm1(2 * log_cos));
    }
  }
  return {sine * std::cos(2 * pi * u.y), sine * std::sin(2 * pi * u.y), cosine};
}

}  // namespace nook::test
