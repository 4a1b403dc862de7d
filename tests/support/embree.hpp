#pragma once

// Embree 3 and 4 by one set of names. NOOK_EMBREE is the version (cmake/Embree.cmake).
#if NOOK_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace nook::embree {

/// How rays are asked for. `coherent`: the rays of a call go much the same way. Stays where it is: Embree 4's
/// arguments point into it.
class Query {
 public:
  explicit Query(bool coherent = false) {
#if NOOK_EMBREE >= 4
    rtcInitRayQueryContext(&context_);
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.context = occluded_.context = &context_;
    intersect_.flags = occluded_.flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
#else
    rtcInitIntersectContext(&context_);
    context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
  }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

#if NOOK_EMBREE >= 4
  void closest(RTCScene scene, RTCRayHit* ray) {
    rtcIntersect1(scene, ray, &intersect_);
  }
  void any(RTCScene scene, RTCRay* ray) {
    rtcOccluded1(scene, ray, &occluded_);
  }
#define NOOK_PACKET(n)                                                 \
  void closest(const int* valid, RTCScene scene, RTCRayHit##n* rays) { \
    rtcIntersect##n(valid, scene, rays, &intersect_);                  \
  }                                                                    \
  void any(const int* valid, RTCScene scene, RTCRay##n* rays) {        \
    rtcOccluded##n(valid, scene, rays, &occluded_);                    \
  }
#else
  void closest(RTCScene scene, RTCRayHit* ray) {
    rtcIntersect1(scene, &context_, ray);
  }
  void any(RTCScene scene, RTCRay* ray) {
    rtcOccluded1(scene, &context_, ray);
  }
  RTCIntersectContext* context() {
    return &context_;
  }
#define NOOK_PACKET(n)                                                 \
  void closest(const int* valid, RTCScene scene, RTCRayHit##n* rays) { \
    rtcIntersect##n(valid, scene, &context_, rays);                    \
  }                                                                    \
  void any(const int* valid, RTCScene scene, RTCRay##n* rays) {        \
    rtcOccluded##n(valid, scene, &context_, rays);                     \
  }
#endif
  NOOK_PACKET(4)
  NOOK_PACKET(8)
  NOOK_PACKET(16)
#undef NOOK_PACKET

 private:
#if NOOK_EMBREE >= 4
  RTCRayQueryContext context_;
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
#else
  RTCIntersectContext context_;
#endif
};

}  // namespace nook::embree
