#include "bench/embree/embree_occlusion.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <thread>

#include "bench/support/stopwatch.hpp"

namespace nook::bench {
namespace {

constexpr unsigned chunk = 512;        // points a thread takes at once
constexpr unsigned stream_rays = 256;  // rays of one 1M or Np call

/// Calls work(begin, end) for chunks of [0, count) on `threads` threads; seconds until the last is done.
template <class Work>
double on_threads(std::size_t count, unsigned threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto loop = [&] {
    for (std::size_t begin; (begin = next.fetch_add(chunk)) < count;)
      work(begin, std::min(count, begin + chunk));
  };
  const Stopwatch watch = started();
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(loop);
  loop();
  for (std::thread& t : others) t.join();
  return watch.seconds();
}

struct Ray {
  vec3 origin, direction;
};

enum class Interface { one, packet4, packet8, packet16, stream_aos, stream_soa };

/// Rays gathered until a call's worth is there; answers go to a sink by index.
template <Interface interface_>
class Tracer {
 public:
  static constexpr unsigned capacity = interface_ == Interface::one        ? 1
                                       : interface_ == Interface::packet4  ? 4
                                       : interface_ == Interface::packet8  ? 8
                                       : interface_ == Interface::packet16 ? 16
                                                                           : stream_rays;

  Tracer(RTCScene scene, bool coherent) : scene_(scene), query_(coherent) {
    std::memset(&soa_, 0, sizeof(soa_));
    for (unsigned i = 0; i < width; ++i) soa_.mask[i] = ~0u;
  }

  bool full() const { return size_ == capacity; }

  void add(const Ray& r, float limit) {
    const unsigned i = size_++;
    if constexpr (interface_ == Interface::one || interface_ == Interface::stream_aos) {
      RTCRay& ray = aos_[i].ray;
      ray.org_x = r.origin.x, ray.org_y = r.origin.y, ray.org_z = r.origin.z, ray.tnear = 0;
      ray.dir_x = r.direction.x, ray.dir_y = r.direction.y, ray.dir_z = r.direction.z, ray.time = 0;
      ray.tfar = limit, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
    } else {
      soa_.org_x[i] = r.origin.x, soa_.org_y[i] = r.origin.y, soa_.org_z[i] = r.origin.z, soa_.tnear[i] = 0;
      soa_.dir_x[i] = r.direction.x, soa_.dir_y[i] = r.direction.y, soa_.dir_z[i] = r.direction.z;
      soa_.tfar[i] = limit;
    }
  }

  void occluded() {
    if constexpr (interface_ == Interface::one) query_.any(scene_, &aos_[0].ray);
#if NOOK_EMBREE < 4
    if constexpr (interface_ == Interface::stream_aos)
      rtcOccluded1M(scene_, query_.context(), &aos_[0].ray, size_, sizeof(aos_[0]));
    if constexpr (interface_ == Interface::stream_soa) {
      RTCRayNp rays = pointers();
      rtcOccludedNp(scene_, query_.context(), &rays, size_);
    }
#endif
    if constexpr (interface_ == Interface::packet4)
      query_.any(valid(), scene_, reinterpret_cast<RTCRay4*>(&soa_));
    if constexpr (interface_ == Interface::packet8)
      query_.any(valid(), scene_, reinterpret_cast<RTCRay8*>(&soa_));
    if constexpr (interface_ == Interface::packet16)
      query_.any(valid(), scene_, reinterpret_cast<RTCRay16*>(&soa_));
  }

  void closest() {
    for (unsigned i = 0; i < size_; ++i)
      (single ? aos_[i].hit.geomID : soa_.geomID[i]) = RTC_INVALID_GEOMETRY_ID;
    if constexpr (interface_ == Interface::one) query_.closest(scene_, &aos_[0]);
#if NOOK_EMBREE < 4
    if constexpr (interface_ == Interface::stream_aos)
      rtcIntersect1M(scene_, query_.context(), aos_, size_, sizeof(aos_[0]));
    if constexpr (interface_ == Interface::stream_soa) {
      RTCRayHitNp rays = {};
      rays.ray = pointers();
      rays.hit.Ng_x = soa_.ng_x, rays.hit.Ng_y = soa_.ng_y, rays.hit.Ng_z = soa_.ng_z;
      rays.hit.u = soa_.u, rays.hit.v = soa_.v, rays.hit.primID = soa_.primID, rays.hit.geomID = soa_.geomID;
      rays.hit.instID[0] = soa_.instID;
      rtcIntersectNp(scene_, query_.context(), &rays, size_);
    }
#endif
    if constexpr (interface_ == Interface::packet4)
      query_.closest(valid(), scene_, reinterpret_cast<RTCRayHit4*>(&soa_));
    if constexpr (interface_ == Interface::packet8)
      query_.closest(valid(), scene_, reinterpret_cast<RTCRayHit8*>(&soa_));
    if constexpr (interface_ == Interface::packet16)
      query_.closest(valid(), scene_, reinterpret_cast<RTCRayHit16*>(&soa_));
  }

  unsigned size() const {
    return size_;
  }
  bool was_occluded(unsigned i) const {
    return (single ? aos_[i].ray.tfar : soa_.tfar[i]) < 0;
  }
  float distance(unsigned i) const {
    const bool miss = (single ? aos_[i].hit.geomID : soa_.geomID[i]) == RTC_INVALID_GEOMETRY_ID;
    return miss ? std::numeric_limits<float>::infinity() : single ? aos_[i].ray.tfar : soa_.tfar[i];
  }
  void clear() {
    size_ = 0;
  }

 private:
  static constexpr bool single = interface_ == Interface::one || interface_ == Interface::stream_aos;
  static constexpr unsigned width = single ? 1 : capacity;

  // RTCRayHit4/8/16's layout, for any width.
  struct alignas(64) Soa {
    float org_x[width], org_y[width], org_z[width], tnear[width], dir_x[width], dir_y[width], dir_z[width],
        time[width];
    float tfar[width];
    unsigned mask[width], id[width], flags[width];
    float ng_x[width], ng_y[width], ng_z[width], u[width], v[width];
    unsigned primID[width], geomID[width], instID[width];
    unsigned instPrimID[width];  // of Embree 4's layout; it stands last
  };

  const int* valid() {
    for (unsigned i = 0; i < width; ++i) valid_[i] = i < size_ ? -1 : 0;
    return valid_;
  }

#if NOOK_EMBREE < 4
  RTCRayNp pointers() {
    RTCRayNp r = {};
    r.org_x = soa_.org_x, r.org_y = soa_.org_y, r.org_z = soa_.org_z, r.tnear = soa_.tnear;
    r.dir_x = soa_.dir_x, r.dir_y = soa_.dir_y, r.dir_z = soa_.dir_z, r.time = soa_.time;
    r.tfar = soa_.tfar, r.mask = soa_.mask, r.id = soa_.id, r.flags = soa_.flags;
    return r;
  }
#endif

  RTCScene scene_;
  embree::Query query_;
  unsigned size_ = 0;
  Soa soa_;
  alignas(64) RTCRayHit aos_[single ? capacity : 1] = {};
  alignas(64) int valid_[width];
};

template <Interface interface_>
double shared(bool coherent, const EmbreeScene& scene, const std::vector<RayPoint>& points,
              const DirectionSets& sets, float limit, unsigned threads, std::vector<std::uint32_t>& bits) {
  bits.assign(points.size(), 0);
  return on_threads(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    Tracer<interface_> tracer(scene.get(), coherent);
    std::array<std::uint32_t, Tracer<interface_>::capacity> whose, which;
    const auto flush = [&] {
      tracer.occluded();
      for (unsigned j = 0; j < tracer.size(); ++j)
        if (tracer.was_occluded(j)) bits[whose[j]] |= 1u << which[j];
      tracer.clear();
    };
    for (std::size_t i = begin; i < end; ++i) {
      const auto basis = tangents(points[i].axis);
      const vec3* set = &sets.directions[set_of_point(unsigned(i)) * sets.size];
      for (unsigned k = 0; k < sets.size; ++k) {
        const vec3 d = to_world(set[k], basis, points[i].axis);
        const vec3& n = points[i].normal;
        if (!(d.x * n.x + d.y * n.y + d.z * n.z > 0)) continue;
        whose[tracer.size()] = std::uint32_t(i);
        which[tracer.size()] = k;
        tracer.add({points[i].origin, d}, limit);
        if (tracer.full()) flush();
      }
      // Packets hold rays of one point: those of two points together are slower.
      if (tracer.size() > 0 && (Tracer<interface_>::capacity <= 16 || i + 1 == end)) flush();
    }
  });
}

template <Interface interface_>
double own(bool coherent, const EmbreeScene& scene, const std::vector<RayPoint>& points,
           const DirectionSets& sets, float limit, unsigned threads, std::vector<std::uint32_t>& bits) {
  bits.assign((points.size() + 31) / 32, 0);
  return on_threads(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    Tracer<interface_> tracer(scene.get(), coherent);
    std::array<std::uint32_t, Tracer<interface_>::capacity> whose;
    const auto flush = [&] {
      tracer.occluded();
      for (unsigned j = 0; j < tracer.size(); ++j)
        if (tracer.was_occluded(j)) bits[whose[j] / 32] |= 1u << whose[j] % 32;
      tracer.clear();
    };
    for (std::size_t i = begin; i < end; ++i) {
      const vec3 d = to_world(sets.directions[set_of_point(unsigned(i)) * sets.size],
                              tangents(points[i].axis), points[i].axis);
      const vec3& n = points[i].normal;
      if (!(d.x * n.x + d.y * n.y + d.z * n.z > 0)) continue;
      whose[tracer.size()] = std::uint32_t(i);
      tracer.add({points[i].origin, d}, limit);
      if (tracer.full()) flush();
    }
    if (tracer.size() > 0) flush();
  });
}

template <Interface interface_>
double closest(bool coherent, const EmbreeScene& scene, const vec3& eye, const std::vector<vec3>& directions,
               unsigned threads, std::vector<float>& distances) {
  distances.resize(directions.size());
  return on_threads(directions.size(), threads, [&](std::size_t begin, std::size_t end) {
    Tracer<interface_> tracer(scene.get(), coherent);
    std::size_t first = begin;
    for (std::size_t i = begin; i < end; ++i) {
      tracer.add({eye, directions[i]}, std::numeric_limits<float>::infinity());
      if (!tracer.full() && i + 1 < end) continue;
      tracer.closest();
      for (unsigned j = 0; j < tracer.size(); ++j) distances[first + j] = tracer.distance(j);
      first = i + 1;
      tracer.clear();
    }
  });
}

template <Interface interface_>
void add_variants(const std::string& name, std::vector<EmbreeVariant>& out) {
  using namespace std::placeholders;
  for (const bool coherent : {false, true})
    out.push_back({name + (coherent ? " coherent" : " incoherent"),
                   std::bind(shared<interface_>, coherent, _1, _2, _3, _4, _5, _6),
                   std::bind(own<interface_>, coherent, _1, _2, _3, _4, _5, _6),
                   std::bind(closest<interface_>, coherent, _1, _2, _3, _4, _5)});
}

}  // namespace

std::vector<EmbreeVariant> embree_variants() {
  std::vector<EmbreeVariant> variants;
  add_variants<Interface::one>("1", variants);
  add_variants<Interface::packet4>("4", variants);
  add_variants<Interface::packet8>("8", variants);
  add_variants<Interface::packet16>("16", variants);
#if NOOK_EMBREE < 4  // which has no calls for streams
  add_variants<Interface::stream_aos>("1M", variants);
  add_variants<Interface::stream_soa>("Np", variants);
#endif
  return variants;
}

}  // namespace nook::bench
