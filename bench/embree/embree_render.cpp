// The yardstick of `nook_bench end-to-end`: an ambient occlusion renderer on Embree as one would write it,
// with nook's reader of scenes and meshes, its camera, its samples and its EXR writer. From process start to
// the file:
//   load, rtcCommitScene (MEDIUM), packets of 16 camera rays, packets of 16 occlusion rays, write.
// Cosine-distributed directions and the Sobol sampler only. Compiled for the machine it is built on.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <thread>

#include "base/error.hpp"
#include "base/threads.hpp"
#include "bench/embree/embree_scene.hpp"
#include "image/exr.hpp"
#include "kernels/shared/task.h"
#include "plan/plan.hpp"
#include "plan/scene_mesh.hpp"
#include "scene/scene_toml.hpp"

// The kernels' random numbers, compiled as C++: both sides draw the same points.
namespace nook::bench::samples {
#include "tests/support/opencl_as_cpp.hpp"
#define SAMPLER 3
#include "kernels/sample/sampler.cl"
#undef __constant
}  // namespace nook::bench::samples

namespace nook::bench {
namespace {

constexpr int packet = 16, tile = 32;

struct Point {
  vec3 origin, normal;
  std::uint32_t pixel, sample;
};

/// r and phi of the concentric map (Shirley and Chiu 1997), lifted to the cosine-weighted hemisphere.
vec3 square_to_cosine_hemisphere(const samples::float2& u) {
  const float a = 2 * u.x - 1 + 0x1p-24f, b = 2 * u.y - 1 + 0x1p-24f;
  const float r = std::abs(a) > std::abs(b) ? a : b;
  const float phi = std::abs(a) > std::abs(b) ? float(M_PI_4) * (b / a)
                    : b != 0                  ? float(M_PI_2) - float(M_PI_4) * (a / b)
                                              : 0.0f;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt((1 - r) * (1 + r))};
}

/// Duff et al. 2017.
vec3 to_world(const vec3& d, const vec3& n) {
  const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  return d.x * vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x) +
         d.y * vec3(b, sign + n.y * n.y * a, -n.y) + d.z * n;
}

class Renderer {
 public:
  Renderer(const Plan& plan, const TriangleMesh& mesh, const EmbreeScene& scene)
      : plan_(plan), mesh_(mesh), scene_(scene), sums_(std::size_t(plan.width) * std::size_t(plan.height)) {
    params_.total_samples = plan.spp;
    params_.total_directions = plan.directions;
    params_.seed = plan.seed;
    params_.width = std::uint32_t(plan.width);
    // Off the surface by a share of the scene's size, as programs commonly do.
    offset_ = 1e-5f * mesh.bounds.bounding_radius();
  }

  std::vector<float> run(unsigned threads) {
    const int across = (plan_.width + tile - 1) / tile, down = (plan_.height + tile - 1) / tile;
    std::atomic<int> next{0};
    const auto work = [&] {
      for (int i; (i = next++) < across * down;) render_tile(i % across * tile, i / across * tile);
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
    work();
    for (std::thread& t : others) t.join();
    return std::move(sums_);
  }

 private:
  void render_tile(int left, int top) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> samples;  // pixel, camera sample
    samples.reserve(packet);
    for (int y = top; y < std::min(top + tile, plan_.height); ++y)
      for (int x = left; x < std::min(left + tile, plan_.width); ++x)
        for (std::uint32_t s = 0; s < plan_.spp; ++s) {
          samples.emplace_back(std::uint32_t(y) * std::uint32_t(plan_.width) + std::uint32_t(x), s);
          if (samples.size() == packet) {
            render(samples);
            samples.clear();
          }
        }
    render(samples);
  }

  void render(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& samples) {
    alignas(64) int valid[packet] = {};
    RTCRayHit16 rays;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      valid[i] = -1;
      set(rays.ray, i, vec3(plan_.camera.eye[0], plan_.camera.eye[1], plan_.camera.eye[2]),
          camera_direction(samples[i].first, samples[i].second), std::numeric_limits<float>::infinity());
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    embree::Query(true).closest(valid, scene_.get(), &rays);
    Occlusion occlusion(*this);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const Point p = point(rays, i, samples[i].first, samples[i].second);
      for (std::uint32_t d = 0; d < plan_.directions; ++d) {
        const auto u = samples::sample_direction(p.pixel, p.sample, d, &params_);
        occlusion.add(p, to_world(square_to_cosine_hemisphere(u), p.normal));
      }
    }
    occlusion.flush();
  }

  vec3 camera_direction(std::uint32_t pixel, std::uint32_t sample) const {
    const CameraParams& c = plan_.camera;
    const auto u = samples::sample_pixel(pixel, sample, &params_);
    const float x = float(pixel % params_.width) + u.x, y = float(pixel / params_.width) + u.y;
    const float px = (2 * x / float(c.width) - 1) * c.tan_half_fov_x,
                py = (1 - 2 * y / float(c.height)) * c.tan_half_fov_y;
    return glm::normalize(px * vec3(c.right[0], c.right[1], c.right[2]) +
                          py * vec3(c.up[0], c.up[1], c.up[2]) +
                          vec3(c.forward[0], c.forward[1], c.forward[2]));
  }

  Point point(const RTCRayHit16& rays, std::size_t i, std::uint32_t pixel, std::uint32_t sample) const {
    const std::uint32_t triangle = rays.hit.primID[i];
    const float u = rays.hit.u[i], v = rays.hit.v[i];
    const auto& t = mesh_.triangles[triangle];
    const vec3 &p0 = mesh_.positions[t[0]], &p1 = mesh_.positions[t[1]], &p2 = mesh_.positions[t[2]];
    vec3 normal = glm::normalize(glm::cross(p1 - p0, p2 - p0));
    if (plan_.vertex_normals) {
      const auto& n = mesh_.triangle_normals[triangle];
      if (n[0] != TriangleMesh::no_normal && n[1] != TriangleMesh::no_normal &&
          n[2] != TriangleMesh::no_normal)
        normal = glm::normalize((1 - u - v) * mesh_.normals[n[0]] + u * mesh_.normals[n[1]] +
                                v * mesh_.normals[n[2]]);
    }
    return {(1 - u - v) * p0 + u * p1 + v * p2 + offset_ * normal, normal, pixel, sample};
  }

  template <class Rays>
  static void set(Rays& rays, std::size_t i, const vec3& origin, const vec3& direction, float limit) {
    rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z, rays.tnear[i] = 0;
    rays.dir_x[i] = direction.x, rays.dir_y[i] = direction.y, rays.dir_z[i] = direction.z, rays.time[i] = 0;
    rays.tfar[i] = limit, rays.mask[i] = ~0u, rays.id[i] = 0, rays.flags[i] = 0;
  }

  /// Occlusion rays gathered into packets; the open ones are counted in their pixels.
  class Occlusion {
   public:
    explicit Occlusion(Renderer& renderer) : renderer_(renderer) {}
    void add(const Point& p, const vec3& direction) {
      set(rays_, size_, p.origin, direction, renderer_.plan_.effects[0].max_distance);
      valid_[size_] = -1;
      pixel_[size_] = p.pixel;
      if (++size_ == packet) flush();
    }
    void flush() {
      if (size_ == 0) return;
      query_.any(valid_, renderer_.scene_.get(), &rays_);
      for (std::size_t i = 0; i < size_; ++i)
        if (rays_.tfar[i] >= 0) renderer_.sums_[pixel_[i]] += 1;
      std::fill_n(valid_, packet, 0);
      size_ = 0;
    }

   private:
    Renderer& renderer_;
    embree::Query query_;
    RTCRay16 rays_;
    alignas(64) int valid_[packet] = {};
    std::uint32_t pixel_[packet];
    std::size_t size_ = 0;
  };

  const Plan& plan_;
  const TriangleMesh& mesh_;
  const EmbreeScene& scene_;
  EstimatorParams params_{};
  float offset_ = 0;
  std::vector<float> sums_;
};

void render(const std::string& scene_file, const std::string& output, unsigned threads, bool robust) {
  limit_own_threads(threads);
  threads = threads_to_use();
  const Scene scene = load_scene(scene_file);
  const TriangleMesh mesh = load_scene_mesh(scene, needed_attributes(scene));
  const Plan plan = make_plan(scene, mesh);
  if (plan.effects.size() != 1 || plan.effects[0].effect.kind != EffectKind::ao ||
      plan.effects[0].effect.sampling != Sampling::cosine || plan.sampler != Sampler::sobol)
    throw Error(ErrorKind::usage, scene_file + ": AO by cosine-distributed Sobol samples alone is supported");
  const EmbreeScene embree(mesh, robust, threads);
  std::vector<float> values = Renderer(plan, mesh, embree).run(threads);
  for (float& value : values) value /= float(plan.spp * plan.directions);
  Image image{plan.width, plan.height, {}, {}};
  for (const char* channel : {"R", "G", "B"}) image.channels.push_back({channel, values});
  write_exr(output, image);
}

}  // namespace
}  // namespace nook::bench

int main(int argc, char** argv) {
  CLI::App app{"Ambient occlusion by Embree: what nook_bench end-to-end compares nook with"};
  std::string scene, output;
  unsigned threads = 0;
  bool robust = false;
  app.add_option("scene", scene, "TOML")->required();
  app.add_option("-o,--output", output, "EXR")->required();
  app.add_option("--threads", threads, "0: all");
  app.add_flag("--robust", robust, "Embree's watertight test");
  try {
    app.parse(argc, argv);
    nook::bench::render(scene, output, threads, robust);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "nook_bench_embree_render: %s\n", e.what());
    return int(e.kind());
  }
  return 0;
}
