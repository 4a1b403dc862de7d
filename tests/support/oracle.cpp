#include "support/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>

#include "support/embree.hpp"
#include "support/warp_oracle.hpp"

namespace nook::test {
namespace {

dvec3 corner(const TriangleMesh& mesh, std::uint32_t triangle, int k) {
  return dvec3(mesh.positions[mesh.triangles[triangle][k]]);
}

// Solves o + t d = p0 + u (p1 - p0) + v (p2 - p0).
std::optional<OracleHit> hit_triangle(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& o,
                                      const dvec3& d) {
  dvec3 p0 = corner(mesh, triangle, 0), e1 = corner(mesh, triangle, 1) - p0,
        e2 = corner(mesh, triangle, 2) - p0;
  dvec3 normal = glm::cross(e1, e2);
  double determinant = -glm::dot(d, normal);
  if (determinant == 0) return std::nullopt;
  dvec3 to_origin = o - p0, c = glm::cross(to_origin, d);
  double t = glm::dot(to_origin, normal) / determinant;
  double u = glm::dot(e2, c) / determinant, v = -glm::dot(e1, c) / determinant;
  if (t > 0 && u >= 0 && v >= 0 && u + v <= 1) return OracleHit{t, u, v, triangle};
  return std::nullopt;
}

// A unit vector at right angles to n, and the third.
void basis(const dvec3& n, dvec3& x, dvec3& y) {
  x = glm::normalize(glm::cross(std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0), n));
  y = glm::cross(n, x);
}

dvec3 turned(const dvec3& axis, const dvec3& local) {
  dvec3 x, y;
  basis(axis, x, y);
  return local.x * x + local.y * y + local.z * axis;
}

struct Surface {
  dvec3 point, normal, side;  // side: the geometric normal on the shading normal's side
};

Surface surface_at(const TriangleMesh& mesh, const OracleHit& hit) {
  double w = 1 - hit.u - hit.v;
  dvec3 p0 = corner(mesh, hit.triangle, 0), p1 = corner(mesh, hit.triangle, 1),
        p2 = corner(mesh, hit.triangle, 2);
  Surface s{w * p0 + hit.u * p1 + hit.v * p2, glm::normalize(glm::cross(p1 - p0, p2 - p0)), {}};
  s.side = s.normal;
  if (mesh.has_normals()) {
    const auto& index = mesh.triangle_normals[hit.triangle];
    if (index[0] != mesh.no_normal && index[1] != mesh.no_normal && index[2] != mesh.no_normal)
      s.normal = glm::normalize(w * dvec3(mesh.normals[index[0]]) + hit.u * dvec3(mesh.normals[index[1]]) +
                                hit.v * dvec3(mesh.normals[index[2]]));
  }
  if (glm::dot(s.side, s.normal) < 0) s.side = -s.side;
  return s;
}

}  // namespace

OracleTracer brute_force(const TriangleMesh& mesh) {
  auto count = std::uint32_t(mesh.triangles.size());
  auto closest = [&mesh, count](const dvec3& o, const dvec3& d) {
    std::optional<OracleHit> best;
    for (std::uint32_t i = 0; i < count; ++i)
      if (auto hit = hit_triangle(mesh, i, o, d); hit && (!best || hit->t < best->t)) best = hit;
    return best;
  };
  auto occluded = [&mesh, count](const dvec3& o, const dvec3& d, double limit) {
    for (std::uint32_t i = 0; i < count; ++i)
      if (auto hit = hit_triangle(mesh, i, o, d); hit && hit->t < limit) return true;
    return false;
  };
  return {closest, occluded, 1e-9};
}

namespace {

OracleTracer embree(const TriangleMesh& mesh, RTCSceneFlags flags) {
  std::shared_ptr<RTCDeviceTy> device(rtcNewDevice("threads=1"), rtcReleaseDevice);
  if (!device) throw std::runtime_error("Embree has no device");
  std::shared_ptr<RTCSceneTy> scene(rtcNewScene(device.get()), [device](RTCScene s) { rtcReleaseScene(s); });
  rtcSetSceneFlags(scene.get(), flags);
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(vec3), mesh.positions.size());
  std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<vec3*>(vertices));
  using Triangle = std::array<std::uint32_t, 3>;
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(Triangle), mesh.triangles.size());
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());

  auto ray_of = [](const dvec3& o, const dvec3& d, double limit) {
    RTCRay ray{};
    ray.org_x = float(o.x), ray.org_y = float(o.y), ray.org_z = float(o.z);
    ray.dir_x = float(d.x), ray.dir_y = float(d.y), ray.dir_z = float(d.z);
    ray.tfar = float(limit);
    ray.mask = 0xffffffffu;
    return ray;
  };
  auto closest = [scene, ray_of](const dvec3& o, const dvec3& d) -> std::optional<OracleHit> {
    RTCRayHit query{};
    query.ray = ray_of(o, d, std::numeric_limits<double>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    embree::Query().closest(scene.get(), &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return OracleHit{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
  };
  auto occluded = [scene, ray_of](const dvec3& o, const dvec3& d, double limit) {
    RTCRay ray = ray_of(o, d, limit);
    embree::Query().any(scene.get(), &ray);
    return ray.tfar < 0;
  };
  return {closest, occluded, 1e-5};
}

}  // namespace

OracleTracer embree_robust(const TriangleMesh& mesh) {
  return embree(mesh, RTC_SCENE_FLAG_ROBUST);
}

OracleTracer embree_fast(const TriangleMesh& mesh) {
  return embree(mesh, RTC_SCENE_FLAG_NONE);
}

ReferenceImage reference_image(const Scene& scene, const TriangleMesh& mesh, const OracleTracer& tracer,
                               double limit, int samples, std::uint64_t seed) {
  const Effect& effect = scene.effects.front();
  const Camera& camera = scene.camera;
  dvec3 eye(camera.eye), forward = glm::normalize(dvec3(camera.at) - eye);
  dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up))), up = glm::cross(right, forward);
  double half_height = std::tan(camera.fov * std::numbers::pi / 360),
         half_width = half_height * scene.width / scene.height;
  double extent = glm::length(dvec3(mesh.bounds.hi) - dvec3(mesh.bounds.lo));
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform;

  ReferenceImage image{scene.width, scene.height, double(samples), {}, {}};
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      double sum = 0, square = 0;
      for (int k = 0; k < samples; ++k) {
        double px = (2 * (x + uniform(engine)) / scene.width - 1) * half_width;
        double py = (1 - 2 * (y + uniform(engine)) / scene.height) * half_height;
        dvec3 d = glm::normalize(px * right + py * up + forward);
        auto hit = tracer.closest(eye, d);
        if (!hit) continue;
        Surface s = surface_at(mesh, *hit);
        glm::dvec2 u(uniform(engine), uniform(engine));
        dvec3 w;
        double weight = 1;
        if (effect.kind == EffectKind::ro) {
          dvec3 mirror = d - 2 * glm::dot(d, s.normal) * s.normal;
          w = turned(mirror, oracle_direction(Warp::cosine_power, u, effect.exponent));
          weight = (effect.exponent + 2.0) / (effect.exponent + 1.0) * std::max(0.0, glm::dot(w, s.normal));
        } else {
          w = turned(s.normal, oracle_direction(Warp::cosine_hemisphere, u, 0));
        }
        if (weight == 0 || tracer.occluded(s.point + tracer.offset * extent * s.side, w, limit)) continue;
        sum += weight;
        square += weight * weight;
      }
      double mean = sum / samples;
      image.mean.push_back(mean);
      image.variance.push_back((square / samples - mean * mean) / (samples - 1));
    }
  return image;
}

}  // namespace nook::test
