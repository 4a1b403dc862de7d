#pragma once

#include <span>
#include <string>
#include <vector>

#include "device/program_cache.hpp"
#include "math/types.hpp"

namespace nook {

/// The maps of kernels/sample/warp.cl from the unit square to directions about +z (or to the unit disk).
enum class Warp { disk, sphere, hemisphere, cosine_hemisphere, cosine_power };

/// Runs the renderer's own warps on arrays, for whoever wants their distributions without a picture.
///
///   Device device(select_device(""));
///   Warps warps(device);
///   std::vector<vec3> lobe = warps.map(Warp::cosine_power, points, 300.0f);
///
/// `exponent` (0 to 1e7) matters for cosine_power alone. Every call throws Error(device) if OpenCL fails.
class Warps {
 public:
  /// `device` must outlive this.
  explicit Warps(const Device& device);
  /// The same from other (flattened) source with the entry points of kernels/sample/warps.cl.
  Warps(const Device& device, const std::string& source);

  /// u in [0,1)²: unit vectors; for the disk (x, y, 0).
  std::vector<vec3> map(Warp warp, std::span<const vec2> u, float exponent = 0) const;
  /// The point in [0,1)² that is mapped to w, for w in the warp's range: inverse(map(u)) = u within 1e-6.
  std::vector<vec2> inverse(Warp warp, std::span<const vec3> w, float exponent = 0) const;
  /// Density of the mapped points: with respect to solid angle, 1/sr (the disk: to area).
  std::vector<float> pdf(Warp warp, std::span<const vec3> w, float exponent = 0) const;

 private:
  std::vector<float> run(const char* kernel, Warp warp, float exponent, std::span<const float> in,
                         std::size_t count, std::size_t floats_out) const;

  const Device& device_;
  BuiltProgram program_;
};

}  // namespace nook
