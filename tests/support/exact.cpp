#include "support/exact.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace nook::test {
namespace {

using Integer = boost::multiprecision::int512_t;
using Whole = std::array<Integer, 3>;

Whole whole(const vec3& v) {
  Whole made;
  for (int i = 0; i < 3; ++i) {
    int exponent = 0;
    const auto mantissa = std::int64_t(std::ldexp(std::frexp(double(v[i]), &exponent), 53));
    const int shift = exponent - 53 + 60;
    made[std::size_t(i)] = shift >= 0 ? Integer(mantissa) << shift : Integer(mantissa >> -shift);
  }
  return made;
}

Whole operator-(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Integer determinant(const Whole& a, const Whole& b, const Whole& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double determinant(const dvec3& a, const dvec3& b, const dvec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

// What the products of a determinant amount to without cancelling.
double permanent(const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 p = glm::abs(a), q = glm::abs(b), r = glm::abs(c);
  return p.x * (q.y * r.z + q.z * r.y) + p.y * (q.z * r.x + q.x * r.z) + p.z * (q.x * r.y + q.y * r.x);
}

}  // namespace

ExactMeeting exact_meeting(const vec3& o, const vec3& d, const vec3& a, const vec3& b, const vec3& c) {
  const dvec3 origin(o), along(d), p[3] = {dvec3(a) - origin, dvec3(b) - origin, dvec3(c) - origin};
  // Edges' moments about the line, the origin's height and the approach; and what doubles may be off.
  double edge[3], off[3];
  for (int i = 0; i < 3; ++i) {
    edge[i] = determinant(along, p[(i + 1) % 3], p[(i + 2) % 3]);
    off[i] = 1e-14 * permanent(along, glm::abs(p[(i + 1) % 3]), glm::abs(p[(i + 2) % 3]));
  }
  double height = determinant(p[0], p[1], p[2]), approach = edge[0] + edge[1] + edge[2];
  ExactMeeting made;
  made.from_edge = HUGE_VAL;
  const auto exact = [&](int i) {
    const Whole start = whole(o);
    const vec3* const corners[3] = {&a, &b, &c};
    return determinant(whole(d), whole(*corners[(i + 1) % 3]) - start, whole(*corners[(i + 2) % 3]) - start);
  };
  for (int i = 0; i < 3; ++i) {
    const double across = glm::length(glm::cross(along, p[(i + 2) % 3] - p[(i + 1) % 3]));
    double moment = std::abs(edge[i]);
    if (off[i] > 1e-3 * moment) moment = std::ldexp(std::abs(exact(i).convert_to<double>()), -180);
    made.from_edge = std::min(made.from_edge, across > 0 ? moment / across : 0);
  }
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (edge[i] > off[i] && edge[k] < -off[k]) return made;  // surely outside
  const bool sure =
      std::all_of(&edge[0], &edge[3], [&](double& e) { return std::abs(e) > off[&e - edge]; }) &&
      std::abs(height) > 1e-9 * permanent(p[0], p[1], p[2]);
  if (!sure) {
    const Whole start = whole(o), q[3] = {whole(a) - start, whole(b) - start, whole(c) - start};
    Integer sum = 0;
    bool above = true, below = true;
    for (int i = 0; i < 3; ++i) {
      const Integer moment = exact(i);
      above = above && moment > 0;
      below = below && moment < 0;
      sum += moment;
    }
    made.inside = above || below;
    if (!made.inside) return made;
    // Both have the scale 2^180.
    height = determinant(q[0], q[1], q[2]).convert_to<double>();
    approach = sum.convert_to<double>();
  }
  made.inside = true;
  made.t = height / approach;
  const dvec3 u = p[1] - p[0], v = p[2] - p[0], normal = glm::cross(u, v);
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  made.cosine = std::abs(glm::dot(along, glm::normalize(normal)));
  made.shape = glm::length(normal) / (longest * longest);
  return made;
}

}  // namespace nook::test
