#include "bench/support/rays.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace nook::bench {

DirectionSets direction_sets(unsigned size, float exponent) {
  DirectionSets sets;
  sets.size = size;
  std::mt19937 random(1);
  const auto uniform = [&] { return double(random()) * 0x1p-32; };
  for (unsigned set = 0; set < DirectionSets::count; ++set) {
    const double shift_u = uniform(), shift_v = uniform();
    for (unsigned k = 0; k < size; ++k) {
      const double u = std::fmod((k + 0.5) / size + shift_u, 1.0);
      const double v = std::fmod(k * 0.6180339887498949 + shift_v, 1.0);
      const double cosine = std::pow(1.0 - u, 1.0 / (exponent + 1.0));
      const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
      sets.directions.push_back(vec3(sine * std::cos(2 * M_PI * v), sine * std::sin(2 * M_PI * v), cosine));
    }
  }
  return sets;
}

std::vector<vec3> camera_directions(const BenchScene& scene, unsigned resolution, unsigned samples) {
  const vec3 forward = glm::normalize(scene.at - scene.eye);
  const vec3 right = glm::normalize(glm::cross(forward, vec3(0, 1, 0))), up = glm::cross(right, forward);
  const double half = std::tan(scene.fov * M_PI / 360);
  std::vector<vec3> result;
  result.reserve(std::size_t(resolution) * resolution * samples);
  for (unsigned tile = 0; tile < resolution * resolution / 64; ++tile)
    for (unsigned i = 0; i < 64; ++i) {
      const unsigned x = tile % (resolution / 8) * 8 + i % 8, y = tile / (resolution / 8) * 8 + i / 8;
      for (unsigned s = 0; s < samples; ++s) {
        const double dx = (s + 0.5) / samples, dy = std::fmod(s * 0.6180339887498949 + 0.5, 1.0);
        const float sx = float((2 * (x + dx) / resolution - 1) * half),
                    sy = float((1 - 2 * (y + dy) / resolution) * half);
        result.push_back(glm::normalize(forward + sx * right + sy * up));
      }
    }
  return result;
}

std::vector<RayPoint> visible_points(const BenchScene& scene, const EmbreeScene& embree_scene,
                                     const std::vector<vec3>& directions, bool mirrored) {
  std::vector<RayPoint> points;
  embree::Query query;
  for (const vec3& d : directions) {
    RTCRayHit hit = {};
    hit.ray.org_x = scene.eye.x, hit.ray.org_y = scene.eye.y, hit.ray.org_z = scene.eye.z;
    hit.ray.dir_x = d.x, hit.ray.dir_y = d.y, hit.ray.dir_z = d.z;
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.closest(embree_scene.get(), &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const auto& t = scene.mesh.triangles[hit.hit.primID];
    const dvec3 a = scene.mesh.positions[t[0]], b = scene.mesh.positions[t[1]],
                c = scene.mesh.positions[t[2]];
    const double u = hit.hit.u, v = hit.hit.v;
    const dvec3 p = (1 - u - v) * a + u * b + v * c;
    dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    if (!(length > 0)) continue;
    n *= (glm::dot(n, dvec3(d)) > 0 ? -1 : 1) / length;
    // Off the surface by far more than its rounding error: no ray is in doubt about the surface it leaves.
    const double offset =
        2e-6 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + glm::length(p - dvec3(scene.eye)));
    const dvec3 axis = mirrored ? dvec3(d) - 2 * glm::dot(dvec3(d), n) * n : n;
    points.push_back({vec3(p + offset * n), vec3(axis), vec3(n)});
  }
  return points;
}

}  // namespace nook::bench
