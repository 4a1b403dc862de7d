#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook::test {

/// What the oracle needs to know of a ray's first hit.
struct OracleHit {
  double t = 0, u = 0, v = 0;  ///< hit = (1-u-v) p0 + u p1 + v p2
  std::uint32_t triangle = 0;
};

/// How the oracle traces: by testing all triangles, or by Embree.
struct OracleTracer {
  std::function<std::optional<OracleHit>(const dvec3& origin, const dvec3& direction)> closest;
  /// The open segment origin + t direction, 0 < t < limit.
  std::function<bool(const dvec3& origin, const dvec3& direction, double limit)> occluded;
  double offset = 0;  ///< how far off a surface rays must start, relative to the scene's extent
};

/// Every triangle in double precision (Cramer's rule): no tree, no float.
OracleTracer brute_force(const TriangleMesh& mesh);

/// Embree 3 with RTC_SCENE_FLAG_ROBUST, and as it is by default, faster and with gaps at edges.
OracleTracer embree_robust(const TriangleMesh& mesh);
OracleTracer embree_fast(const TriangleMesh& mesh);

/// An image with the variance of each pixel's mean, from `count` independent samples a pixel.
struct ReferenceImage {
  int width = 0, height = 0;
  double count = 0;
  std::vector<double> mean, variance;
};

/// AO or RO of a scene as the project defines them, computed without its code: own camera, Mersenne twister,
/// polar warps, bases by cross products, double precision. AO draws cosine-weighted, RO from the lobe.
/// `limit`: the rays' length. Uses scene's camera, size and its first effect's kind and exponent.
ReferenceImage reference_image(const Scene& scene, const TriangleMesh& mesh, const OracleTracer& tracer,
                               double limit, int samples, std::uint64_t seed);

}  // namespace nook::test
