#include "bench/ssao/ssao_reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "base/error.hpp"
#include "ssao/view.hpp"
#include "support/embree.hpp"

namespace nook::bench {
namespace {

// Rays start off the surface by this share of the scene's size.
constexpr float offset_share = 2e-6f;

template <typename Body>
void parallel_chunks(std::size_t count, std::size_t chunk, const Body& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t begin; (begin = next.fetch_add(chunk)) < count;)
      body(begin, std::min(count, begin + chunk));
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

void orthonormal_basis(const vec3& n, vec3& s, vec3& t) {
  const vec3 helper = std::abs(n.x) > 0.7f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  s = glm::normalize(glm::cross(helper, n));
  t = glm::cross(n, s);
}

}  // namespace

struct ReferenceTracer::State {
  const TriangleMesh* mesh;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float offset = 0;
};

ReferenceTracer::ReferenceTracer(const TriangleMesh& mesh) : state_(std::make_unique<State>()) {
  state_->mesh = &mesh;
  state_->offset = offset_share * mesh.bounds.bounding_radius();
  state_->device = rtcNewDevice(nullptr);
  if (!state_->device) throw Error(ErrorKind::internal, "cannot make an Embree device");
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size()));
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(state_->scene);
}

ReferenceTracer::~ReferenceTracer() {
  rtcReleaseScene(state_->scene);
  rtcReleaseDevice(state_->device);
}

std::vector<PrimaryHit> ReferenceTracer::primary(const Camera& camera, int width, int height,
                                                 const std::vector<std::uint32_t>& pixels) const {
  const SsaoView view = make_ssao_view(camera, width, height, 0);
  const TriangleMesh& mesh = *state_->mesh;
  std::vector<PrimaryHit> hits(pixels.size());
  parallel_chunks(pixels.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const vec2 center(float(pixels[i] % unsigned(width)) + 0.5f, float(pixels[i] / unsigned(width)) + 0.5f);
      const vec3 direction = view.direction_to_world(view.reconstruct(center, 1.0f));
      RTCRayHit ray{};
      ray.ray.org_x = view.eye.x, ray.ray.org_y = view.eye.y, ray.ray.org_z = view.eye.z;
      ray.ray.dir_x = direction.x, ray.ray.dir_y = direction.y, ray.ray.dir_z = direction.z;
      ray.ray.tfar = std::numeric_limits<float>::infinity();
      ray.ray.mask = ~0u;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::Query().closest(state_->scene, &ray);
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      PrimaryHit& hit = hits[i];
      hit.hit = true;
      const auto& triangle = mesh.triangles[ray.hit.primID];
      const float u = ray.hit.u, v = ray.hit.v;
      const vec3 p0 = mesh.positions[triangle[0]], p1 = mesh.positions[triangle[1]],
                 p2 = mesh.positions[triangle[2]];
      hit.position = (1 - u - v) * p0 + u * p1 + v * p2;
      hit.geometric_normal = vec3(glm::normalize(glm::cross(dvec3(p1 - p0), dvec3(p2 - p0))));
      hit.shading_normal = hit.geometric_normal;
      if (!mesh.has_normals()) continue;
      const auto& n = mesh.triangle_normals[ray.hit.primID];
      if (n[0] == TriangleMesh::no_normal || n[1] == TriangleMesh::no_normal ||
          n[2] == TriangleMesh::no_normal)
        continue;
      const vec3 sum = (1 - u - v) * mesh.normals[n[0]] + u * mesh.normals[n[1]] + v * mesh.normals[n[2]];
      if (glm::dot(sum, sum) > 1e-12f) hit.shading_normal = glm::normalize(sum);
    }
  });
  return hits;
}

std::vector<ReferenceTracer::Estimate> ReferenceTracer::ambient(const std::vector<PrimaryHit>& hits,
                                                                float radius, int grid,
                                                                std::uint64_t seed) const {
  std::vector<Estimate> estimates(hits.size());
  parallel_chunks(hits.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::seed_seq key{seed, std::uint64_t(begin)};
    std::mt19937 random(key);
    const auto uniform = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto open_share = [&](const vec3& origin, const vec3& n, const vec3& s, const vec3& t) {
      int open = 0;
      const int count = grid * grid;
      for (int first = 0; first < count; first += 16) {
        alignas(64) RTCRay16 rays;
        alignas(64) int valid[16];
        for (int k = 0; k < 16; ++k) {
          valid[k] = first + k < count ? -1 : 0;
          const float u = (float((first + k) % grid) + uniform()) / float(grid);
          const float phi = 6.2831853f * (float((first + k) / grid) + uniform()) / float(grid);
          const float r = std::sqrt(u);
          const vec3 d = r * std::cos(phi) * s + r * std::sin(phi) * t + std::sqrt(1 - u) * n;
          rays.org_x[k] = origin.x, rays.org_y[k] = origin.y, rays.org_z[k] = origin.z;
          rays.dir_x[k] = d.x, rays.dir_y[k] = d.y, rays.dir_z[k] = d.z;
          rays.tnear[k] = 0, rays.tfar[k] = radius, rays.time[k] = 0;
          rays.mask[k] = ~0u, rays.id[k] = 0, rays.flags[k] = 0;
        }
        embree::Query().any(valid, state_->scene, &rays);
        for (int k = 0; k < 16; ++k) open += valid[k] && !(rays.tfar[k] < 0);
      }
      return float(open) / float(count);
    };
    for (std::size_t i = begin; i < end; ++i) {
      const PrimaryHit& hit = hits[i];
      if (!hit.hit) continue;
      const float side = glm::dot(hit.geometric_normal, hit.shading_normal) < 0 ? -1.0f : 1.0f;
      const vec3 origin = hit.position + side * state_->offset * hit.geometric_normal;
      vec3 s, t;
      orthonormal_basis(hit.shading_normal, s, t);
      float halves[2];
      for (float& half : halves) half = open_share(origin, hit.shading_normal, s, t);
      const float difference = halves[0] - halves[1];
      estimates[i] = {0.5f * (halves[0] + halves[1]), 0.25f * difference * difference};
    }
  });
  return estimates;
}

}  // namespace nook::bench
