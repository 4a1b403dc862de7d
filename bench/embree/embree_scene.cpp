#include "bench/embree/embree_scene.hpp"

#include <cstring>
#include <string>

#include "base/error.hpp"
#include "bench/support/stopwatch.hpp"

namespace nook::bench {

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, bool robust, unsigned threads) {
  device_ = rtcNewDevice(threads ? ("threads=" + std::to_string(threads)).c_str() : nullptr);
  if (!device_) throw Error(ErrorKind::device, "Embree cannot be started");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  const Stopwatch watch = started();
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(vec3), mesh.positions.size());
  std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(vec3));
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), mesh.triangles.size());
  std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
  commit_seconds_ = watch.seconds();
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace nook::bench
