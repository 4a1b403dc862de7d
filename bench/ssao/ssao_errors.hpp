#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/ssao/ssao_reference.hpp"

namespace nook::bench {

/// Ray-traced AO at some pixels of an image, with which estimates are compared.
struct Reference {
  int width, height;
  std::vector<std::uint32_t> pixels;  ///< y * width + x
  std::vector<PrimaryHit> hits;
  std::vector<ReferenceTracer::Estimate> ambient;
};

/// 2 grid^2 directions at one pixel in each block of 4x4, at a place that varies. Errors are those over all
/// pixels to within 1 %, for a sixteenth of the rays.
Reference trace_reference(const ReferenceTracer& tracer, const Camera& camera, int width, int height,
                          float radius, int grid);

/// How values a differ from a reference b.
class Differences {
 public:
  void add(double value, const ReferenceTracer::Estimate& reference);
  double bias() const { return (a_ - b_) / n_; }
  double mae() const { return absolute_ / n_; }
  /// The reference's own variance is subtracted.
  double rmse() const;
  double correlation() const;

 private:
  double n_ = 0, a_ = 0, b_ = 0, aa_ = 0, bb_ = 0, ab_ = 0, absolute_ = 0, variance_ = 0;
};

struct Errors {
  Differences all, inner, border;  ///< the border: within a sixteenth of the width or height of the edge
};

/// Over the pixels that see the mesh; value: of a pixel.
Errors errors_of(const Reference& reference, const std::function<double(std::uint32_t pixel)>& value);
nlohmann::json json_of(const Errors& errors);

}  // namespace nook::bench
