#include "bench/ssao/ssao_equal_time.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "ssao/view.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook::bench {
namespace {

Scene one_ao(Scene scene, float radius) {
  scene.effects = {Effect{}};
  scene.effects[0].max_distance = {DistanceLimit::Kind::value, radius};
  scene.spp = 1;
  return scene;
}

}  // namespace

TracedAo::TracedAo(const Scene& scene, const TriangleMesh& mesh, float radius)
    : renderer_(one_ao(scene, radius), TriangleMesh(mesh), [] { return Device(select_device("")); }) {
  const double one = run(1).seconds, many = run(17).seconds;
  seconds_per_direction_ = (many - one) / 16;
  seconds_of_camera_rays_ = std::max(0.0, one - seconds_per_direction_);
}

TracedAo::Result TracedAo::in_time(double seconds) const {
  const double directions = (seconds - seconds_of_camera_rays_) / seconds_per_direction_;
  return run(std::uint32_t(std::clamp(directions, 1.0, 4096.0)));
}

TracedAo::Result TracedAo::run(std::uint32_t directions) const {
  Scene scene = renderer_.scene();
  scene.directions = directions;
  SceneRenderer renderer(renderer_, scene);
  const std::vector<std::uint32_t> pixels = pixels_in_order(renderer.plan().window, renderer.plan().width);
  OcclusionTracer& tracer = renderer.tracer();
  Result result{directions, 1e30, {}};
  for (int round = 0; round < 3 && (round == 0 || result.seconds < 1); ++round) {
    std::vector<Film> films = tracer.make_films();
    const auto start = std::chrono::steady_clock::now();
    tracer.accumulate(pixels, {0, directions}, films);
    result.seconds = std::min(
        result.seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    result.values.resize(pixels.size());
    for (std::uint32_t i = 0; i < pixels.size(); ++i) result.values[i] = films.front().value(i);
  }
  return result;
}

std::vector<float> edge_aware_blur(const Camera& camera, int width, int height,
                                   const std::vector<PrimaryHit>& hits, std::vector<float> values, int radius,
                                   float depth_tolerance) {
  const SsaoView view = make_ssao_view(camera, width, height, 0);
  // The plane n x = n p has inverse depth w(q) = n (q ray_scale + ray_offset, -1) / n p, affine in q.
  std::vector<vec3> planes(values.size(), vec3(0));  // w and its change per pixel to the right and downwards
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!hits[i].hit) continue;
    const vec3 p = view.to_view(hits[i].position), world = hits[i].geometric_normal;
    const vec3 n(glm::dot(view.right, world), glm::dot(view.up, world), glm::dot(view.backward, world));
    const float distance = glm::dot(n, p);
    planes[i] = vec3(-1 / p.z, n.x * view.ray_scale.x / distance, n.y * view.ray_scale.y / distance);
  }
  for (const int axis : {0, 1}) {
    const int size = axis == 0 ? width : height;
    const std::ptrdiff_t stride = axis == 0 ? 1 : width;
    std::vector<float> out = values;
    for (std::ptrdiff_t i = 0; i < std::ptrdiff_t(values.size()); ++i) {
      const vec3& own = planes[std::size_t(i)];
      if (own.x == 0) continue;
      const int place = int(axis == 0 ? i % width : i / width);
      float sum = values[std::size_t(i)], weights = 1;
      for (int k = -radius; k <= radius; ++k) {
        if (k == 0 || place + k < 0 || place + k >= size) continue;
        const std::size_t other = std::size_t(i + k * stride);
        if (planes[other].x == 0) continue;
        const float off = std::abs(planes[other].x - (own.x + float(k) * own[1 + axis]));
        const float end = std::abs(k) == radius ? 0.5f : 1.0f;
        const float weight = end * std::max(0.0f, 1 - off / (own.x * depth_tolerance));
        sum += weight * values[other];
        weights += weight;
      }
      out[std::size_t(i)] = sum / weights;
    }
    values = std::move(out);
  }
  return values;
}

}  // namespace nook::bench
