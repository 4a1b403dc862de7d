#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "bvh/bvh.hpp"
#include "device/device.hpp"
#include "device/program_cache.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook::testing {

/// Up to 32 rays that share an origin, as the stream kernels take them.
struct RayStream {
  vec3 origin{0};
  std::array<vec3, 32> direction{};
};

struct ClosestHit {
  float t = 0, u = 0, v = 0;
  std::uint32_t triangle = 0;
};

/// The arguments of offset_origin().
struct SurfaceSample {
  vec3 p0, p1, p2, normal;
  float u = 0, v = 0, side = 1;
};

/// A way of traversal.
struct TraversalVariant {
  std::string name = "stream";
  BuildOptions options = {};
  unsigned width = 16;  ///< children of a node
  bool avx512 = true;   ///< if the device has it
};
std::ostream& operator<<(std::ostream& out, const TraversalVariant& variant);

/// A mesh on the device, and the traversal's queries as kernels.
class RayTester {
 public:
  RayTester(const TriangleMesh& mesh, const TraversalVariant& variant = {});
  /// Another mesh for the same kernels.
  void take(const TriangleMesh& mesh);

  /// Bit k of element i: ray k of stream i is occluded.
  std::vector<std::uint32_t> occluded(const std::vector<RayStream>& streams, float max_distance);
  /// The same through the query that takes an origin for each ray.
  std::vector<std::uint32_t> occluded_own_origins(const std::vector<RayStream>& streams, float max_distance);
  /// 32 hits a stream.
  std::vector<ClosestHit> closest(const std::vector<RayStream>& streams, float limit);
  std::vector<vec3> offset_origins(const std::vector<SurfaceSample>& samples);

 private:
  std::vector<std::uint32_t> bits(const char* kernel, const std::vector<RayStream>& streams,
                                  float max_distance);

  unsigned width_;
  Bvh bvh_;
  Device& device_;
  BuiltProgram program_;
};

/// The distinct ways of traversal: every one must give the same answers.
std::vector<TraversalVariant> traversal_variants();

}  // namespace nook::testing
